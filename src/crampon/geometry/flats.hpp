#pragma once
/// Regions without a boundary curve of their own: everywhere, half-plane (half-space), point, line.

#include "crampon/geometry/region.hpp"

namespace crampon {

/// All of the plane or of space.
struct Everywhere final : Region {
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>&) const override { return {}; }
  Bounds3 bounds() const override;
  int dimension() const override { return 0; }
};

/// Points on the side of a straight line (in space: plane) away from its outward normal, the line included.
class HalfPlane final : public Region {
 public:
  /// point in m; normal of any length but zero; dimension 2 or 3 (half-space).
  HalfPlane(const Vec<3>& point, const Vec<3>& normal, int dimension);
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>&) const override { return normal_; }
  Bounds3 bounds() const override;
  int dimension() const override { return dimension_; }

 private:
  Vec<3> point_, normal_;
  int dimension_;
};

/// One point. In 2D its z is unused.
class Point final : public Region {
 public:
  Point(const Vec<3>& point, int dimension);
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override { return 0.; }
  int dimension() const override { return dimension_; }

 private:
  Vec<3> point_;
  int dimension_;
};

/// Straight segment between two points, both included. In 2D their z is unused.
class Line final : public Region {
 public:
  Line(const Vec<3>& from, const Vec<3>& to, int dimension);
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override { return 0.; }
  int dimension() const override { return dimension_; }

 private:
  Vec<3> from_, to_;
  int dimension_;
};

}  // namespace crampon
