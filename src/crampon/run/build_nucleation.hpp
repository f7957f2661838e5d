#pragma once
/// Cracks that may start during a run: they are there from its start, without vertices, so that columns, laws and numbers of cracks stay the same
/// (docs/decisions/0027-nucleation.md).

#include <vector>

#include "crampon/run/build_bodies.hpp"
#include "crampon/state/state.hpp"

namespace crampon {

/// The cracks of a [[nucleation]] with their laws, all but growth. After the cracks of the input.
void reserve_cracks(const Problem& problem, const NucleationInput& in, Model<2>& model, State<2>& state, std::vector<Diagnostic>& errors);

/// When and where they start. interval: between two looks at stress, s; first: number of the first of its cracks.
NucleationModel build_nucleation(const Problem& problem, const NucleationInput& in, const BuiltBodies<2>& bodies, const Model<2>& model,
                                 double interval, std::uint32_t first);

}  // namespace crampon
