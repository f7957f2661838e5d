#pragma once
/// Shapes made of shapes: union, intersection, difference. Closed sets: the boundary of what is taken away stays.

#include <vector>

#include "crampon/geometry/region.hpp"

namespace crampon {

/// Points in any of the parts (at least one part).
class Union final : public Region {
 public:
  explicit Union(std::vector<RegionPtr> parts);
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  bool contains(const Vec<3>& x, double slack = 0) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;
  int dimension() const override;

 private:
  std::vector<RegionPtr> parts_;
};

/// Points in all of the parts (at least one part).
class Intersection final : public Region {
 public:
  explicit Intersection(std::vector<RegionPtr> parts);
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  bool contains(const Vec<3>& x, double slack = 0) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;
  int dimension() const override;

 private:
  std::vector<RegionPtr> parts_;
};

/// Points of a shape that are not strictly inside any of the shapes taken away.
class Difference final : public Region {
 public:
  Difference(RegionPtr whole, std::vector<RegionPtr> taken_away);
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override { return whole_->bounds(); }
  int dimension() const override;

 private:
  RegionPtr whole_;
  std::vector<RegionPtr> taken_away_;
};

}  // namespace crampon
