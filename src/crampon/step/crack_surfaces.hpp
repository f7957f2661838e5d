#pragma once
/// The nodes about a point of a crack, and what is seen from there.

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

/// A node as a crack point sees it: S and the node's place in the arrays.
struct NodeShare {
  double S;
  Vec<2> x;
  std::uint32_t block;
  int local;
};

/// The nodes that S reaches from x, of blocks that are there.
ForNodes<NodeShare> nodes_around(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x);

/// What can be seen from beside a crack, of the cracks as State::crack_view has them.
class CrackSurfaces {
 public:
  CrackSurfaces(const StepWork<2>& work, const Model<2>& model)
      : model_(model), view_(work.crack_view), nudge_(1e-8 * model.grid.smallest_cell()) {}

  /// A hair beside a vertex of the plane, to the side of the unit vector `out`. On a mirror, where the path ends but not the crack, a little
  /// inside the body.
  Vec<2> beside(const Vec<2>& vertex, const Vec<2>& out) const;
  /// Bit i is set when a crack lies between `from` and place i, of up to most_nodes_in_plane.
  unsigned hidden(const Vec<2>& from, std::span<const Vec<2>> places) const;

 private:
  const Model<2>& model_;
  const CrackView& view_;
  double nudge_;  ///< m
};

}  // namespace crampon
