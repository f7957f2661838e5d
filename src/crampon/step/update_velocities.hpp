#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Task 5, velocities: v += dt sum S a (N03 Eq. 30), and Task 6c: tile sums of the new momenta with the S and
/// fields of the start of the step (N03 Eq. 31).
template <int Dim, class Shape>
void update_velocities_and_project(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
