#pragma once
/// What is seen from a point between the particles: the nodes about it, the cracks between it and other places, and at each node the velocity field of
/// the material on its side. Planes and surface points of cracks ask here, and so does whoever needs a field beside a crack.

#include <array>
#include <cstdint>
#include <span>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Some things, at most as many as the widest stencil has nodes.
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
  std::array<T, most_nodes_in_plane> list_;
  std::size_t count_ = 0;
};

/// Unit normal at a vertex, from above to below: the mean of the segments that meet there, behind a mirror the image of the last one.
Vec<2> vertex_normal(const Crack<2>& crack, std::size_t vertex);

/// A node as a point sees it.
struct PointNode {
  double S = 0;             ///< of a point without size (docs/theory/kinematics.md, shape functions)
  Vec<2> G;                 ///< its gradient, 1/m
  Vec<2> x;                 ///< of the node, m
  std::uint32_t block = 0;  ///< where it lives ...
  int local = 0;            ///< ... and its number there
  std::size_t slot = 0;     ///< in the nodal arrays, of the field that the point sees; only as PointFields::at finds it
};
using PointNodes = ForNodes<PointNode>;

class PointFields {
 public:
  /// Cracks are those of StepWork::crack_view; nodes have what the last stage of the step has left there.
  PointFields(const StepWork<2>& work, const Model<2>& model) : work_(work), model_(model), nudge_(1e-8 * model.grid.smallest_cell()) {}

  /// The nodes that S reaches from x, of blocks that are there, whatever lies between.
  PointNodes nodes(const Vec<2>& x) const;

  /// The nodes about x with the slot of the velocity field that material field `field` has on the side of x: that of particles at x. Nodes at which
  /// it has no mass are left out, so that S need not add up to 1. For the side of a crack on which x lies see beside().
  PointNodes at(const Vec<2>& x, std::uint16_t field) const;

  /// A hair beside a vertex of a crack's plane, to the side of the unit vector `out`. On a mirror, where the path ends but not the crack, a
  /// little inside the body.
  Vec<2> beside(const Vec<2>& vertex, const Vec<2>& out) const;

  /// Bit i is set when a crack lies between `from` and place i, of up to most_nodes_in_plane.
  unsigned hidden(const Vec<2>& from, std::span<const Vec<2>> places) const;

 private:
  template <class F>
  void for_crossings(const Vec<2>& from, std::span<const Vec<2>> places, F f) const;

  const StepWork<2>& work_;
  const Model<2>& model_;
  double nudge_;  ///< m
};

/// Of the nodes that PointFields::at has found: velocity, m/s, and its gradient, 1/s, by their sums S v and v G.
Vec<2> velocity_at(const StepWork<2>& work, const PointNodes& nodes);
std::array<Vec<2>, 2> velocity_gradient_at(const StepWork<2>& work, const PointNodes& nodes);

}  // namespace crampon
