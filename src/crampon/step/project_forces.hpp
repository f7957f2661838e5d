#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Task 3, for one block: tile sums of internal forces (N03 Eq. 28), of loads and of what keeps rigid bodies on their way. Of body force and
/// damping only what is special to folded pairs; nodes add the rest.
template <int Dim, class Shape>
void project_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// The same after the stress update of Task 2 (USF, USAVG) with the nodal velocities at hand, pack by pack (N03 Eqs. 34-36).
template <int Dim, class Shape>
void update_stress_and_project_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
