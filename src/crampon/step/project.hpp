#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Task 1: tile sums of m v S and m S per layer (N03 Eq. 26), for one block.
template <int Dim, class Shape>
void project_momentum(State<Dim>& state, const Model<Dim>& model, std::size_t block);

/// Task 1, only where fields or walls meet: tile sums of volume and its gradient, position and original position (N03 Eq. 27; N13 sec. 3).
template <int Dim, class Shape>
void project_contact_sums(State<Dim>& state, const Model<Dim>& model, std::size_t block);

/// Stress update over `stress_dt` with the nodal velocities at hand (0: none; N03 Eqs. 34-36), then Task 3: tile sums of internal
/// forces, of loads and of what keeps rigid bodies on their way. load_values: per load and component, N or Pa. Of body force, m/s2,
/// and damping, 1/s, only what is special to folded pairs; nodes add the rest.
template <int Dim, class Shape>
void update_stress_and_project_forces(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt, double stress_dt,
                                      const std::vector<Vec<Dim>>& load_values, const Vec<Dim>& body_force, double damping);

}  // namespace crampon
