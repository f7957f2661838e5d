#pragma once
/// The nodes about a point of a crack's surface, and which fields there belong to that surface.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

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

/// A node with mass on one side of all cracks.
struct SurfaceNode {
  NodeShare node;
  Signature side;
  Pack p;  ///< {p, m} there, of all materials (N13 sec. 2.9)
  double weight = 0;
};

/// The nodes about a point of a surface; none where no node has mass. The weights add up to 1 and serve motion and tractions alike, so that
/// a traction's work on the nodes is its work on the opening. They are those of the plane, S: where faces press on each other they share
/// the normal velocity at every node, and both surfaces then move as one; weights by mass let them drift by the strain over a third of a
/// cell. Only nodes with less than half the mean mass weigh less, in proportion: a traction would throw them about.
class SurfaceNodes {
 public:
  const SurfaceNode* begin() const { return list_.data(); }
  const SurfaceNode* end() const { return list_.data() + count_; }
  bool empty() const { return count_ == 0; }

 private:
  friend class CrackSurfaces;
  std::array<SurfaceNode, 9> list_;
  std::size_t count_ = 0;
};

/// The cracks as they are now, ready to tell which fields lie on which of their sides.
class CrackSurfaces {
 public:
  CrackSurfaces(const State<2>& state, const Model<2>& model);

  /// Where a side is looked at from: the surface point; where that may lie a hair beyond a crack and would go with the wrong side for good,
  /// that is while its own crack is closed or across another one, the vertex of the plane, moved a little to the side. On a mirror, where the
  /// path ends but not the crack, a little inside the body.
  Vec<2> above(const Crack<2>& crack, std::size_t vertex) const;
  Vec<2> below(const Crack<2>& crack, std::size_t vertex) const;

  /// The nodes around x with mass on the side of `from`.
  SurfaceNodes nodes(const Vec<2>& from, const Vec<2>& x) const;
  /// f(slot of the node in the nodal arrays) for the fields of one side of all cracks; not those of rigid bodies.
  template <class F>
  void for_layers(const NodeShare& node, const Signature& side, F f) const {
    const BlockLayers<2>& layers = state_.nodes.layers[node.block];
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (layers.node[l].cracks != side || model_.is_whole(layers.node[l].field)) continue;
      f(layers.slot(l, node.local));
    }
  }

 private:
  /// `above` or `below`, for the surface on that side of the plane: -1 or 1 along the vertex normal.
  Vec<2> seen_from(const Crack<2>& crack, std::size_t vertex, const Vec<2>& surface, double side) const;
  /// x, which belongs to the vertex; where that lies on a mirror, x as far along the mirror and a little inside.
  Vec<2> off_mirrors(Vec<2> x, const Vec<2>& vertex) const;
  bool within_reach(const Vec<2>& from, const Vec<2>& x) const;
  /// Cracks between `from` and each of up to nine places, into sides; bit i of what is returned: too many for place i.
  unsigned signatures(const Vec<2>& from, std::span<const Vec<2>> places, bool near, Signature* sides) const;

  const State<2>& state_;
  const Model<2>& model_;
  std::vector<CrackPath> paths_;
  FacetBins bins_;
  double nudge_ = 0;  ///< m
};

}  // namespace crampon
