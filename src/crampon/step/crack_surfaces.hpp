#pragma once
/// The nodes about a point of a crack's surface, and which fields there belong to that surface.

#include <array>
#include <cstdint>
#include <span>

#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Up to nine things, as many as a stencil has nodes.
template <class T>
class ForNodes {
 public:
  const T* begin() const { return list_.data(); }
  const T* end() const { return list_.data() + count_; }
  T* begin() { return list_.data(); }
  T* end() { return list_.data() + count_; }
  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  const T* data() const { return list_.data(); }
  const T& operator[](std::size_t i) const { return list_[i]; }
  void push_back(const T& item) { list_[count_++] = item; }

 private:
  std::array<T, 9> list_;
  std::size_t count_ = 0;
};

/// Unit normal at a vertex, from above to below: the mean of the segments that meet there.
Vec<2> vertex_normal(const Crack<2>& crack, std::size_t vertex);

/// A node as a crack point sees it: S and the node's place in the arrays.
struct NodeShare {
  double S;
  Vec<2> x;
  std::uint32_t block;
  int local;
};

/// The nodes that S reaches from x, of blocks that are there.
ForNodes<NodeShare> nodes_around(const State<2>& state, const Model<2>& model, const Vec<2>& x);

/// A node with mass on one side of all cracks.
struct SurfaceNode {
  NodeShare node;
  Signature side;
  Pack p;  ///< {p, m} there, of all materials (N13 sec. 2.9)
  double weight;
};

/// The nodes about a point of a surface; none where no node has mass. The weights add up to 1 and serve motion and tractions alike, so that
/// a traction's work on the nodes is its work on the opening. They are those of the plane, S: where faces press on each other they share
/// the normal velocity at every node, and both surfaces then move as one; weights by mass let them drift by the strain over a third of a
/// cell. Only nodes with less than half the mean mass weigh less, in proportion: a traction would throw them about.
using SurfaceNodes = ForNodes<SurfaceNode>;

/// Tells which fields lie on which side of the cracks as State::crack_view has them.
class CrackSurfaces {
 public:
  CrackSurfaces(const State<2>& state, const Model<2>& model)
      : state_(state), model_(model), view_(state.crack_view), nudge_(1e-8 * model.grid.smallest_cell()) {}

  /// The nodes about the two surface points of a vertex, each with mass on its own side.
  struct Faces {
    SurfaceNodes upper, lower;
  };
  Faces faces(const Crack<2>& crack, std::size_t vertex) const;

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
  /// Where a side is looked at from: the surface point; where that may lie a hair beyond a crack and would go with the wrong side for good,
  /// that is while its own crack is closed or across another one, the vertex of the plane, moved a little to the side. On a mirror, where the
  /// path ends but not the crack, a little inside the body. `out` is the unit normal at the vertex to that side.
  Vec<2> seen_from(const Vec<2>& vertex, const Vec<2>& surface, const Vec<2>& out) const;
  /// The nodes around x with mass on the side of `from`.
  SurfaceNodes nodes(const Vec<2>& from, const Vec<2>& x) const;
  /// x, which belongs to the vertex; where that lies on a mirror, x as far along the mirror and a little inside.
  Vec<2> off_mirrors(Vec<2> x, const Vec<2>& vertex) const;
  /// Cracks between `from` and each of up to nine places, into sides; bit i of what is returned: too many for place i.
  unsigned signatures(const Vec<2>& from, std::span<const Vec<2>> places, Signature* sides) const;

  const State<2>& state_;
  const Model<2>& model_;
  const CrackView& view_;
  double nudge_;  ///< m
};

}  // namespace crampon
