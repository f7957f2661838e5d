#pragma once
/// What particles bear together: mass, momentum and energy, for the books of the run (docs/theory/contact.md, energy).

#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// Over all particles but those of rigid bodies, whose masses are volumes.
template <int Dim>
ParticleSums<Dim> sum_particles(const State<Dim>& state, const Model<Dim>& model);

/// Books what a particle that is about to be removed takes along.
template <int Dim>
void book_departure(State<Dim>& state, const Model<Dim>& model, const Run& run, std::size_t particle);

}  // namespace crampon
