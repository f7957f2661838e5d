#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Task 5, velocities: v += dt sum S a (N03 Eq. 30), and Task 6c: tile sums of the new momenta with the S and
/// fields of the start of the step (N03 Eq. 31).
template <int Dim, class Shape>
void update_velocities_and_project(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt);

/// The end of the step: stress update over stress_dt with the nodal velocities at hand (0: none), velocities if not done before,
/// then positions: x += dt sum S v with the velocities of Task 6, or of Task 4 where there are no others (N03 Eq. 30). Finds the box that particles now reach and their health.
template <int Dim, class Shape>
void finish_particles(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt, double stress_dt, bool with_velocities);

/// Work of loads on particles over the step, f_p . sum S (v' - a dt/2) dt, to the block's ledger, and what body force on mirror images
/// takes from the nodes' account. Before positions advance.
template <int Dim, class Shape>
void account_loads(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt, const std::vector<Vec<Dim>>& load_values,
                   const Vec<Dim>& body_force);

}  // namespace crampon
