#pragma once
/// The energy books of the run (docs/theory/contact.md, energy).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// In the first step, and when contact by volume is measured against the body as it was: nodal volumes of the uncut body at the
/// start, sum V_p S (conventions 10).
template <int Dim, class Shape>
void record_initial_volume(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// The step is done: its time has passed.
template <int Dim>
void close_step(State<Dim>& state, StepWork<Dim>& work);

/// Adds up the blocks' sums of the step in block order and clears them; decides whether particles are re-ordered.
template <int Dim>
void close_ledger(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Over all particles but those of rigid bodies, whose masses are volumes.
template <int Dim>
ParticleSums<Dim> sum_particles(const State<Dim>& state, const Model<Dim>& model);

/// Books what a particle that is about to be removed takes along.
template <int Dim>
void book_departure(State<Dim>& state, const Model<Dim>& model, const Run& run, std::size_t particle);

}  // namespace crampon
