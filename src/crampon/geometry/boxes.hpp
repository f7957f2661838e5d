#pragma once
/// Axis-aligned rectangle and box.

#include "crampon/geometry/region.hpp"

namespace crampon {

/// Points with low <= x <= high in x and y; an edge when low == high on an axis.
struct Rectangle final : Region {
  Vec<2> low, high;  ///< m
  Rectangle(const Vec<2>& low_corner, const Vec<2>& high_corner) : low(low_corner), high(high_corner) {}
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;
};

/// Points with low <= x <= high in x, y and z; a face, edge or point when low == high on an axis.
struct Box final : Region {
  Vec<3> low, high;  ///< m
  Box(const Vec<3>& low_corner, const Vec<3>& high_corner) : low(low_corner), high(high_corner) {}
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override { return {low, high}; }
  std::optional<double> measure() const override;
  int dimension() const override { return 3; }
};

}  // namespace crampon
