#pragma once
#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Finds the layers at the nodes of each block from those of the tiles around it, and gives every tile and node its place in the arrays of Nodes.
/// \param crossing  [block][crack of the tile][tile node]: sums over pairs that cross cracks
template <int Dim, class Shape>
void lay_out_nodes(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, const std::vector<std::vector<CrossingSums>>& crossing);

}  // namespace crampon
