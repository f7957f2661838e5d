#pragma once
#include <cstddef>

#include "crampon/input/problem.hpp"
#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// [fracture], and growth of cracks: the model of both, and the tips that lie in a body. After cracks and loads. particles: how many there are.
void build_fracture(const Problem& problem, std::size_t particles, Model<2>& model, State<2>& state);

}  // namespace crampon
