#pragma once
/// Shapes turned, shifted and mirrored.

#include <array>

#include "crampon/geometry/region.hpp"

namespace crampon {

/// A shape turned about an axis through a point (2D: about the point, counter-clockwise). Quarter turns about coordinate axes are exact.
class Rotated final : public Region {
 public:
  /// angle in rad, right-handed about `axis` (any length but zero); about: point on the axis, m.
  Rotated(RegionPtr shape, double angle, const Vec<3>& about, const Vec<3>& axis = {{0, 0, 1}});
  double distance(const Vec<3>& x) const override { return shape_->distance(turn_back(x)); }
  Vec<3> outward(const Vec<3>& x) const override;
  bool contains(const Vec<3>& x, double slack = 0) const override { return shape_->contains(turn_back(x), slack); }
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;
  int dimension() const override;

 private:
  Vec<3> turn_back(const Vec<3>& x) const;
  RegionPtr shape_;
  Vec<3> about_;
  std::array<Vec<3>, 3> columns_;  // of the rotation matrix
  bool in_plane_;                  // about the z axis
};

/// A shape shifted by a vector.
class Translated final : public Region {
 public:
  /// by: m
  Translated(RegionPtr shape, const Vec<3>& by);
  double distance(const Vec<3>& x) const override { return shape_->distance(x - by_); }
  Vec<3> outward(const Vec<3>& x) const override { return shape_->outward(x - by_); }
  bool contains(const Vec<3>& x, double slack = 0) const override { return shape_->contains(x - by_, slack); }
  Bounds3 bounds() const override;
  std::optional<double> measure() const override { return shape_->measure(); }
  int dimension() const override { return shape_->dimension(); }

 private:
  RegionPtr shape_;
  Vec<3> by_;
};

/// A shape in the mirror across a coordinate axis.
class Mirrored final : public Region {
 public:
  /// axis: 0, 1 or 2; at: the mirror's coordinate along it, m
  Mirrored(RegionPtr shape, std::size_t axis, double at) : shape_(std::move(shape)), axis_(axis), at_(at) {}
  double distance(const Vec<3>& x) const override { return shape_->distance(image(x)); }
  Vec<3> outward(const Vec<3>& x) const override;
  bool contains(const Vec<3>& x, double slack = 0) const override { return shape_->contains(image(x), slack); }
  Bounds3 bounds() const override;
  std::optional<double> measure() const override { return shape_->measure(); }
  int dimension() const override { return shape_->dimension(); }

 private:
  Vec<3> image(Vec<3> x) const {
    x[axis_] = 2 * at_ - x[axis_];
    return x;
  }
  RegionPtr shape_;
  std::size_t axis_;
  double at_;
};

}  // namespace crampon
