#include "crampon/geometry/solids.hpp"

#include <algorithm>
#include <numbers>

#include "crampon/geometry/direction.hpp"

namespace crampon {

Vec<3> Sphere::outward(const Vec<3>& x) const { return unit_along(x - centre); }

Bounds3 Sphere::bounds() const {
  const Vec<3> reach{{radius, radius, radius}};
  return {centre - reach, centre + reach};
}
std::optional<double> Sphere::measure() const { return 4. / 3. * std::numbers::pi * radius * radius * radius; }

double Cylinder::distance(const Vec<3>& x) const {
  const Vec<3> axis = to - from, r = x - from;
  const double length = norm(axis);
  const double along = dot(axis, r) / length;
  const double across = norm(r - axis * (along / length));
  const double beyond_end = std::max(-along, along - length), beyond_side = across - radius;
  if (beyond_end > 0 && beyond_side > 0) return std::hypot(beyond_end, beyond_side);
  return std::max(beyond_end, beyond_side);
}

Vec<3> Cylinder::outward(const Vec<3>& x) const {
  const Vec<3> axis = to - from, r = x - from;
  const double length = norm(axis);
  const Vec<3> e = axis * (1 / length);
  const double along = dot(e, r);
  const Vec<3> end = along + along >= length ? e : -e;
  // Twice: what the first subtraction leaves along the axis is round-off of a longer vector.
  Vec<3> across = r - along * e;
  across -= dot(e, across) * e;
  const double beyond_end = std::max(-along, along - length), beyond_side = norm(across) - radius;
  if (beyond_end > 0 && beyond_side > 0) return unit_along(beyond_end * end + beyond_side * unit_along(across));
  return beyond_end >= beyond_side ? end : unit_along(across);
}

Bounds3 Cylinder::bounds() const {
  const Vec<3> axis = normalized(to - from);
  Bounds3 box;
  for (int k = 0; k < 3; ++k) {
    // A circle with unit normal n reaches radius*sqrt(1 - n_k^2) along axis k.
    const double reach = radius * std::sqrt(std::max(0., 1 - axis[k] * axis[k]));
    box.low[k] = std::min(from[k], to[k]) - reach;
    box.high[k] = std::max(from[k], to[k]) + reach;
  }
  return box;
}

std::optional<double> Cylinder::measure() const { return std::numbers::pi * radius * radius * norm(to - from); }

}  // namespace crampon
