#pragma once
/// The nodes about a point of a crack's surface, and which fields there belong to that surface.

#include <array>
#include <cstdint>

#include "crampon/crack/crossing.hpp"
#include "crampon/crack/facet_bins.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Unit normal at a vertex, from above to below: the mean of the segments that meet there.
Vec<2> vertex_normal(const Crack<2>& crack, std::size_t vertex);

/// A node as a crack point sees it: S and the node's place in the arrays.
struct NodeShare {
  double S = 0;
  Vec<2> x;
  std::uint32_t block = no_block;
  int local = 0;
};

/// The nodes that S reaches from x; those out of reach have S = 0.
std::array<NodeShare, 9> nodes_around(const State<2>& state, const Model<2>& model, const Vec<2>& x);

/// The cracks as they are now, ready to tell which fields lie on which of their sides.
class CrackSurfaces {
 public:
  CrackSurfaces(const State<2>& state, const Model<2>& model);

  /// Where a side is looked at from: the vertex of the plane, moved a little to it. A surface point itself may lie a hair beyond the plane
  /// while the crack is closed, and would then go with the wrong side for good.
  Vec<2> above(const Crack<2>& crack, std::size_t vertex) const;
  Vec<2> below(const Crack<2>& crack, std::size_t vertex) const;

  /// f(node, p): for the nodes around x with mass on the side of `from`: {p, m} there, of all materials (N13 sec. 2.9).
  template <class F>
  void for_nodes(const Vec<2>& from, const Vec<2>& x, F f) const {
    const bool near = within_reach(from, x);
    for (const NodeShare& node : nodes_around(state_, model_, x)) {
      if (node.block == no_block || node.S == 0) continue;
      Signature side;
      if (!signature(from, node.x, near, side)) continue;
      Pack p = splat(0.);
      for_layers(node, side, [&](std::size_t slot) { p += state_.nodes.momentum[slot]; });
      if (p[2] > 0) f(node, side, p);
    }
  }
  /// f(slot of the node in the nodal arrays) for the fields of one side of all cracks; not those of rigid bodies.
  template <class F>
  void for_layers(const NodeShare& node, const Signature& side, F f) const {
    const BlockLayers<2>& layers = state_.nodes.layers[node.block];
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (layers.node[l].cracks != side || model_.is_rigid(layers.node[l].field)) continue;
      f((layers.node_begin + l) * block_nodes<2> + static_cast<std::size_t>(node.local));
    }
  }

 private:
  bool within_reach(const Vec<2>& from, const Vec<2>& x) const;
  /// Cracks between `from` and a node; false when there are too many.
  bool signature(const Vec<2>& from, const Vec<2>& node, bool near, Signature& side) const;

  const State<2>& state_;
  const Model<2>& model_;
  std::vector<CrackPath> paths_;
  FacetBins bins_;
  double nudge_ = 0;  ///< m
};

}  // namespace crampon
