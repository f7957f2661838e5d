#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Loads, body force and damping at the time of the positions with which the step works, and how particles take up velocities under that
/// damping (StepValues::rule). Serial, as expressions are evaluated here.
template <int Dim>
void evaluate_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
