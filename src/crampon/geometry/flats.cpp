#include "crampon/geometry/flats.hpp"

#include <algorithm>
#include <limits>

#include "crampon/geometry/direction.hpp"

namespace crampon {
namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Bounds3 unbounded{{{-infinity, -infinity, -infinity}}, {{infinity, infinity, infinity}}};

Vec<3> without_z_in_plane(Vec<3> x, int dimension) {
  if (dimension == 2) x[2] = 0;
  return x;
}

// A unit vector across the unit vector e, away from the coordinate axis that lies along it most.
Vec<3> perpendicular_to(const Vec<3>& e) {
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(e[k]) < std::abs(e[least])) least = k;
  Vec<3> across = -e[least] * e;
  across[least] += 1;
  return normalized(across);
}

Bounds3 bounds_of(const Vec<3>& a, const Vec<3>& b, int dimension) {
  Bounds3 box = unbounded;
  for (int k = 0; k < dimension; ++k) {
    box.low[k] = std::min(a[k], b[k]);
    box.high[k] = std::max(a[k], b[k]);
  }
  return box;
}
}  // namespace

double Everywhere::distance(const Vec<3>&) const { return -infinity; }
Bounds3 Everywhere::bounds() const { return unbounded; }

HalfPlane::HalfPlane(const Vec<3>& point, const Vec<3>& normal, int dimension)
    : point_(without_z_in_plane(point, dimension)), normal_(normalized(without_z_in_plane(normal, dimension))), dimension_(dimension) {}

double HalfPlane::distance(const Vec<3>& x) const { return dot(normal_, x - point_); }

Bounds3 HalfPlane::bounds() const {
  // Bounded only when the normal lies along an axis.
  Bounds3 box = unbounded;
  for (int k = 0; k < 3; ++k) {
    if (normal_[k] == 1) box.high[k] = point_[k];
    if (normal_[k] == -1) box.low[k] = point_[k];
  }
  return box;
}

Point::Point(const Vec<3>& point, int dimension) : point_(without_z_in_plane(point, dimension)), dimension_(dimension) {}
double Point::distance(const Vec<3>& x) const { return norm(without_z_in_plane(x, dimension_) - point_); }
Vec<3> Point::outward(const Vec<3>& x) const { return unit_along(without_z_in_plane(x, dimension_) - point_); }
Bounds3 Point::bounds() const { return bounds_of(point_, point_, dimension_); }

Line::Line(const Vec<3>& from, const Vec<3>& to, int dimension)
    : from_(without_z_in_plane(from, dimension)), to_(without_z_in_plane(to, dimension)), dimension_(dimension) {}

double Line::distance(const Vec<3>& x) const {
  const Vec<3> axis = to_ - from_, r = without_z_in_plane(x, dimension_) - from_;
  const double length2 = dot(axis, axis);
  const double along = length2 > 0 ? std::clamp(dot(axis, r) / length2, 0., 1.) : 0;
  return norm(r - along * axis);
}

Vec<3> Line::outward(const Vec<3>& x) const {
  const Vec<3> axis = to_ - from_, r = without_z_in_plane(x, dimension_) - from_;
  const Vec<3> e = unit_along(axis);
  if (e == Vec<3>{}) return unit_along(r);
  const double along = dot(e, r);
  if (along < 0 && r != Vec<3>{}) return unit_along(r);
  if (along > norm(axis) && x != to_) return unit_along(r - axis);
  if (dimension_ == 2) {
    const Vec<3> left{{-e[1], e[0], 0}};
    return dot(left, r) >= 0 ? left : -left;
  }
  // Twice: what the first subtraction leaves along the axis is round-off of a longer vector.
  Vec<3> across = r - along * e;
  across -= dot(e, across) * e;
  if (norm(across) > 1e-15 * norm(r)) return unit_along(across);
  return perpendicular_to(e);
}

Bounds3 Line::bounds() const { return bounds_of(from_, to_, dimension_); }

}  // namespace crampon
