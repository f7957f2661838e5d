#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Task 1: tile sums of m v S and m S per layer (N03 Eq. 26), for one block.
template <int Dim, class Shape>
void project_momentum(State<Dim>& state, const Model<Dim>& model, std::size_t block);

/// Task 1, near cracks only: tile sums of volume, position and original position (N03 Eq. 27; contact.md 2.2).
template <int Dim, class Shape>
void project_contact_sums(State<Dim>& state, const Model<Dim>& model, std::size_t block);

/// Stress update over `stress_dt` with the nodal velocities at hand (0: none; N03 Eqs. 34-36), then Task 3: tile sums of internal
/// forces and of loads (N03 Eq. 28). load_values: per load and component, N. body_force, m/s2: only its mirrored part at symmetry
/// planes is projected; nodes add the rest.
template <int Dim, class Shape>
void update_stress_and_project_forces(State<Dim>& state, const Model<Dim>& model, std::size_t block, double stress_dt,
                                      const std::vector<Vec<Dim>>& load_values, const Vec<Dim>& body_force);

}  // namespace crampon
