#pragma once
/// Faces that prescribed velocities hold, for shape functions that see nodes beyond them (docs/theory/step.md, held faces).

#include <algorithm>
#include <vector>

#include "crampon/shape/stencil.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Nodes of prescribed velocity as the tile of a block sees them; empty for shape functions that see no node beyond.
template <int Dim, class Shape>
class HeldNodes {
 public:
  /// A prescribed component, m/s at the start and the end of the step.
  struct Component {
    int node = 0;  ///< of the tile
    int axis = 0;
    std::uint16_t condition = 0;
    double start = 0, end = 0;
  };

  HeldNodes(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

  bool any() const { return !components_.empty(); }
  /// May a particle in this cell, counted from the tile's first node, see a held node? False for cells outside the tile.
  bool near_cell(const IndexVector<Dim>& cell) const;
  /// Bit k: component k of this node of the grid is held.
  unsigned axes(const IndexVector<Dim>& node) const {
    const int t = tile_node(node);
    return t < 0 || axes_.empty() ? 0u : axes_[static_cast<std::size_t>(t)];
  }
  /// f(component) for what is held at a node of the grid.
  template <class F>
  void for_components(const IndexVector<Dim>& node, F f) const {
    const int t = tile_node(node);
    auto at = std::lower_bound(components_.begin(), components_.end(), t, [](const Component& c, int n) { return c.node < n; });
    for (; at != components_.end() && at->node == t; ++at) f(*at);
  }

 private:
  using T = Tile<Dim, Shape>;
  /// -1 outside.
  int tile_node(const IndexVector<Dim>& node) const {
    int index = 0, stride = 1;
    for (std::size_t k = 0; k < Dim; ++k) {
      const int i = node[k] - first_[k];
      if (i < 0 || i >= T::side) return -1;
      index += i * stride;
      stride *= T::side;
    }
    return index;
  }

  IndexVector<Dim> first_{};           ///< of the tile, in the grid
  std::vector<Component> components_;  ///< by node
  std::vector<std::uint8_t> axes_;     ///< per tile node
  std::vector<std::uint8_t> near_;     ///< per cell of the tile
};

}  // namespace crampon
