#pragma once
/// What is seen from a point between the particles: the nodes about it, the cracks between it and other places, and at each node the velocity field of
/// the material on its side. Planes and surface points of cracks ask here, and so does whoever needs a field beside a crack.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Some things, at most as many as the widest stencil has nodes.
template <int Dim, class T>
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
  std::array<T, most_nodes<Dim>> list_;
  std::size_t count_ = 0;
};

/// Unit normals at the vertices of a crack, from above to below. In the plane the normal halves the corner between the two segments that meet, long
/// or short. In space it is the mean of the triangles about the vertex, weighted by their areas. The last segment before a mirror meets its image
/// there.
template <int Dim>
std::vector<Vec<Dim>> vertex_normals(const Crack<Dim>& crack);

/// A node as a point sees it.
template <int Dim>
struct PointNode {
  double S = 0;             ///< of a point without size (docs/theory/kinematics.md, shape functions)
  Vec<Dim> G;               ///< its gradient, 1/m
  Vec<Dim> x;               ///< of the node, m
  std::uint32_t block = 0;  ///< where it lives ...
  int local = 0;            ///< ... and its number there
  std::size_t slot = 0;     ///< in the nodal arrays, of the field that the point sees; only as PointFields::at finds it
};
template <int Dim>
using PointNodes = ForNodes<Dim, PointNode<Dim>>;

template <int Dim>
class PointFields {
 public:
  /// Cracks are those of StepWork::crack_view; nodes have what the last stage of the step has left there.
  PointFields(const StepWork<Dim>& work, const Model<Dim>& model) : work_(work), model_(model), nudge_(1e-8 * model.grid.smallest_cell()) {}

  /// The nodes that S reaches from x, of blocks that are there, whatever lies between.
  PointNodes<Dim> nodes(const Vec<Dim>& x) const;

  /// The nodes about x with the slot of the velocity field that material field `field` has on the side of x: that of particles at x. Nodes at which
  /// it has no mass are left out, so that S need not add up to 1. For the side of a crack on which x lies see beside().
  PointNodes<Dim> at(const Vec<Dim>& x, std::uint16_t field) const;

  /// A hair beside a vertex of a crack's plane, to the side of the unit vector `out`. On a mirror, where the path ends but not the crack, a
  /// little inside the body.
  Vec<Dim> beside(const Vec<Dim>& vertex, const Vec<Dim>& out) const;

  /// Does a crack lie between a particle and a point, which is not on a crack? A particle on a crack counts as above, as it does for nodes.
  bool parted(const Vec<Dim>& particle, const Vec<Dim>& point) const;

 private:
  template <class F>
  void for_crossings(const Vec<Dim>& from, std::span<const Vec<Dim>> places, F f) const;

  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
  double nudge_;  ///< m
};

/// Of the nodes that PointFields::at has found: velocity, m/s, and its gradient, 1/s, by their sums S v and v G. L[d][k]: of component d along
/// axis k.
template <int Dim>
Vec<Dim> velocity_at(const StepWork<Dim>& work, const PointNodes<Dim>& nodes);
template <int Dim>
std::array<Vec<Dim>, Dim> velocity_gradient_at(const StepWork<Dim>& work, const PointNodes<Dim>& nodes);

}  // namespace crampon
