#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

// Task 5, velocities, where particles do not just add accelerations (step/transfer.hpp). Books what that takes of their energy.

template <int Dim, class Shape>
void take_velocities(State<Dim>& state, const Model<Dim>& model, std::size_t block, const VelocityRule& rule);

/// Task 6 after that: tile sums of the new momenta (N03 Eq. 31).
template <int Dim, class Shape>
void take_velocities_and_project(State<Dim>& state, const Model<Dim>& model, std::size_t block, const VelocityRule& rule);

}  // namespace crampon
