#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

// Task 5, velocities, where particles do not just add accelerations (step/transfer.hpp). Books what that takes of their energy.

template <int Dim, class Shape>
void take_velocities(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 6 after that: tile sums of the new momenta (N03 Eq. 31).
template <int Dim, class Shape>
void take_velocities_and_project(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
