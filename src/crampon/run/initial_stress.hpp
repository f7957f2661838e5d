#pragma once
/// [[body]] initial_stress: particles that bear stress from the start.

#include "crampon/input/problem.hpp"
#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// Gives the particles of bodies with an initial stress the elastic strain that goes with it. Where they lie, how much space they take and
/// what they weigh stays: what was their volume is that under stress, and the volume at no stress follows. A law without a state of that
/// stress adds an error.
template <int Dim>
void bear_initial_stress(const Problem& problem, const Model<Dim>& model, State<Dim>& state, std::vector<Diagnostic>& errors);

}  // namespace crampon
