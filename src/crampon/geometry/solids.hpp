#pragma once
/// Round solids: sphere and cylinder.

#include "crampon/geometry/region.hpp"

namespace crampon {

struct Sphere final : Region {
  Vec<3> centre;  ///< m
  double radius;  ///< m
  Sphere(const Vec<3>& centre_, double radius_) : centre(centre_), radius(radius_) {}
  double distance(const Vec<3>& x) const override { return norm(x - centre) - radius; }
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;
  int dimension() const override { return 3; }
};

/// Right circular cylinder between the centres of its two flat ends.
struct Cylinder final : Region {
  Vec<3> from, to;  ///< m
  double radius;    ///< m
  Cylinder(const Vec<3>& from_, const Vec<3>& to_, double radius_) : from(from_), to(to_), radius(radius_) {}
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override;
  std::optional<double> measure() const override;
  int dimension() const override { return 3; }
};

}  // namespace crampon
