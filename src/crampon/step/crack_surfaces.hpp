#pragma once
/// The nodes about a point of a crack's surface, and which fields there belong to that surface.

#include <array>
#include <cmath>
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

  /// Where a side is looked at from: the surface point; where that may lie a hair beyond a crack and would go with the wrong side for good,
  /// that is while its own crack is closed or across another one, the vertex of the plane, moved a little to the side. On a mirror, where the
  /// path ends but not the crack, a little inside the body.
  Vec<2> above(const Crack<2>& crack, std::size_t vertex) const;
  Vec<2> below(const Crack<2>& crack, std::size_t vertex) const;

  /// f(node, side, p, weight) for the nodes around x with mass on the side of `from`: {p, m} there, of all materials (N13 sec. 2.9). The
  /// weights add up to 1 and serve motion and tractions alike, so that a traction's work on the nodes is its work on the opening. They are
  /// those of the plane, S: where faces press on each other they share the normal velocity at every node, and both surfaces then move as
  /// one; weights by mass let them drift by the strain over a third of a cell. Only nodes with less than half the mean mass weigh less, in
  /// proportion: a traction would throw them about.
  template <class F>
  void for_nodes(const Vec<2>& from, const Vec<2>& x, F f) const {
    const bool near = within_reach(from, x);
    const auto around = nodes_around(state_, model_, x);
    std::array<Signature, 9> sides;
    std::array<Pack, 9> packs;
    double mass = 0, shape = 0;
    for (std::size_t i = 0; i < around.size(); ++i) {
      const NodeShare& node = around[i];
      packs[i] = splat(0.);
      if (node.block == no_block || node.S == 0 || !signature(from, node.x, near, sides[i])) continue;
      for_layers(node, sides[i], [&](std::size_t slot) { packs[i] += state_.nodes.momentum[slot]; });
      if (!(packs[i][2] > 0)) continue;
      mass += node.S * packs[i][2];
      shape += node.S;
    }
    if (!(mass > 0)) return;
    const double light = 0.5 * mass / shape;
    const auto weight = [&](std::size_t i) { return around[i].S * std::fmin(1., packs[i][2] / light); };
    double sum = 0;
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (packs[i][2] > 0) sum += weight(i);
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (packs[i][2] > 0) f(around[i], sides[i], packs[i], weight(i) / sum);
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
  Vec<2> seen_from(const Crack<2>& crack, std::size_t vertex, const Vec<2>& surface, double side) const;
  /// x, which belongs to the vertex; where that lies on a mirror, x as far along the mirror and a little inside.
  Vec<2> off_mirrors(Vec<2> x, const Vec<2>& vertex) const;
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
