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
/// further, s: by which positions were led on before the step (lead_positions), with velocities of particles that are corrected here.
template <int Dim, class Shape>
void finish_particles(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt, double further, double stress_dt,
                      bool with_velocities);

}  // namespace crampon
