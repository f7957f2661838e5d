#pragma once
/// Loads of the input on the particles and faces of bodies.

#include "crampon/run/build_bodies.hpp"
#include "crampon/state/cracks.hpp"

namespace crampon {

/// Fills Model::loads and Model::faces. Errors: a load that selects nothing, a face of a body that has none.
template <int Dim>
void build_loads(const Problem& problem, const BuiltBodies<Dim>& bodies, const Cracks<Dim>& cracks, Model<Dim>& model,
                 std::vector<Diagnostic>& errors);

}  // namespace crampon
