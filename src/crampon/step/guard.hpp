#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Looks at what the blocks reported. Throws RunError naming step, time, particle, its position, the nearest crack and the advice that
/// usually helps; removes particles that left the grid when the input says so.
template <int Dim, class Shape>
void check_health(State<Dim>& state, const Model<Dim>& model, double dt);

}  // namespace crampon
