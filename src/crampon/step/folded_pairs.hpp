#pragma once
/// Pairs of particle and node that a symmetry plane folds (CONVENTIONS 29).

#include <cmath>
#include <vector>

#include "crampon/shape/stencil.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// f(plane) for each symmetry plane in which the particle at x_p sees the node, one mirror after another; `node` and its place x_i end as
/// those of the mirror node. Returns the components that change sign, bit k for axis k.
template <int Dim, class F>
unsigned for_folds(const Model<Dim>& model, const Vec<Dim>& x_p, IndexVector<Dim>& node, Vec<Dim>& x_i, F f) {
  unsigned flip = 0;
  for (const SymmetryPlane& plane : model.symmetries) {
    const auto axis = static_cast<std::size_t>(plane.axis);
    if (flip >> plane.axis & 1u || !folds<Dim>(plane, x_p, x_i)) continue;
    const int on = static_cast<int>(std::lround((plane.at - model.grid.origin[axis]) * model.grid.inverse_cell[axis]));
    node[axis] = 2 * on - node[axis];
    x_i[axis] = model.grid.node_coordinate(plane.axis, node[axis]);
    flip |= 1u << plane.axis;
    f(plane);
  }
  return flip;
}

/// The packs of a block with folded pairs, ascending.
template <int Dim, class Shape>
std::vector<std::uint32_t> folded_packs(const State<Dim>& state, std::size_t b) {
  constexpr std::size_t pairs = std::size_t{lanes} * Tile<Dim, Shape>::stencil;
  const Block<Dim>& block = state.blocks.list[b];
  const BlockLayers<Dim>& layers = state.nodes.layers[b];
  std::vector<std::uint32_t> packs;
  for (std::size_t k = 0; k < layers.special.size(); ++k) {
    if (layers.special[k] < 0) continue;
    const PairTarget* first = &layers.targets[static_cast<std::size_t>(layers.special[k]) * pairs];
    if (std::any_of(first, first + pairs, [](const PairTarget& t) { return t.flip != 0; }))
      packs.push_back(state.blocks.runs[block.first_run].first_pack + static_cast<std::uint32_t>(k));
  }
  return packs;
}

}  // namespace crampon
