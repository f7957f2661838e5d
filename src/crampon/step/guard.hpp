#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Looks at what the input prescribes for this step: motion of rigid bodies, velocities on nodes, loads, body force, damping. Throws RunError
/// that names the first that is not a number, and for damping below zero.
template <int Dim>
void check_prescribed(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model);

/// Looks at what the blocks reported. Throws RunError naming step, time, particle, its position, the nearest crack and the advice that
/// usually helps; removes particles that left the grid when the input says so.
template <int Dim, class Shape>
void check_health(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
