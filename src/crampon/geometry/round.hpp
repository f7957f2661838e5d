#pragma once
/// Round shapes of the plane: disk, ellipse, ring, sector.

#include "crampon/geometry/region.hpp"

namespace crampon {

struct Disk final : Region {
  Vec<2> centre;  ///< m
  double radius;  ///< m
  Disk(const Vec<2>& centre_, double radius_) : centre(centre_), radius(radius_) {}
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;
};

/// Ellipse whose first semi-axis is turned by an angle from the x axis.
class Ellipse final : public Region {
 public:
  /// centre, semi-axes in m; angle in rad, counter-clockwise.
  Ellipse(const Vec<2>& centre, const Vec<2>& semi_axes, double angle = 0);
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  bool contains(const Vec<3>& x, double slack = 0) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;

 private:
  Vec<2> to_axes(const Vec<3>& x) const;  // in the frame of the semi-axes
  Vec<2> centre_, semi_axes_, direction_;
};

/// Points between two concentric circles, both included.
struct Ring final : Region {
  Vec<2> centre;        ///< m
  double inner, outer;  ///< radii, m
  Ring(const Vec<2>& centre_, double inner_, double outer_) : centre(centre_), inner(inner_), outer(outer_) {}
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;
};

/// Slice of a disk, from one angle counter-clockwise to another.
class Sector final : public Region {
 public:
  /// centre, radius in m; angles in rad, from < to <= from + 2 pi.
  Sector(const Vec<2>& centre, double radius, double from, double to);
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;

 private:
  bool whole() const;
  bool between_edges(const Vec<2>& r) const;  // r from the centre
  double distance_to_edge(const Vec<2>& edge, const Vec<2>& r) const;
  Vec<2> centre_;
  double radius_, from_, to_;
  Vec<2> from_edge_, to_edge_;  // directions of the straight edges
};

}  // namespace crampon
