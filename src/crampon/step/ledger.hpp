#pragma once
/// What loads do in a step, and the energy books of the run (docs/theory/contact.md, energy).

#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Loads (N per share), body force (m/s2) and damping (1/s) at a time, s: that of the positions at the start of the step.
template <int Dim>
void evaluate_loads(double time, const Model<Dim>& model, std::vector<Vec<Dim>>& loads, Vec<Dim>& body_force, double& damping);

/// In the first step, and when contact by volume is measured against the body as it was: nodal volumes of the uncut body at the
/// start, sum V_p S (conventions 10).
template <int Dim, class Shape>
void record_initial_volume(State<Dim>& state, const Model<Dim>& model);

/// Adds up the blocks' sums of the step in block order and clears them; decides whether particles are re-ordered.
template <int Dim>
void close_ledger(State<Dim>& state, const Model<Dim>& model);

/// Over all particles but those of rigid bodies, whose masses are volumes.
template <int Dim>
ParticleSums<Dim> sum_particles(const State<Dim>& state, const Model<Dim>& model);

/// Books what a particle that is about to be removed takes along.
template <int Dim>
void book_departure(State<Dim>& state, const Model<Dim>& model, const Run& run, std::size_t particle);

}  // namespace crampon
