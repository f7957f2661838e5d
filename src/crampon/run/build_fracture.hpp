#pragma once

#include "crampon/run/build_bodies.hpp"
#include "crampon/state/state.hpp"

namespace crampon {

/// [fracture], growth of cracks and [[nucleation]]: the models, and the tips that lie in a body or may come to lie in one. After cracks and loads.
void build_fracture(const Problem& problem, const BuiltBodies<2>& bodies, Model<2>& model, State<2>& state);

}  // namespace crampon
