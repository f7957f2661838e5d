#pragma once
/// Unit vectors for outward normals of shapes.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "crampon/core/vector.hpp"

namespace crampon {

/// a/|a|, or zero when a is zero; also where the square of |a| would underflow or overflow.
template <int Dim>
Vec<Dim> unit_along(const Vec<Dim>& a) {
  double largest = 0;
  for (std::size_t k = 0; k < Dim; ++k) largest = std::max(largest, std::abs(a[k]));
  return largest > 0 ? normalized(a * (1 / std::max(largest, 1e-300))) : Vec<Dim>{};
}

/// The unit vector d if it lies between the unit normals of two edges that meet at a corner, else the nearer of these: round-off close to
/// the corner cannot turn it away from both. Zero gives the first.
inline Vec<2> between_normals(const Vec<2>& d, const Vec<2>& first, const Vec<2>& second) {
  if (d == Vec<2>{}) return first;
  const double turn = cross(first, second);
  if (cross(first, d) * turn > 0 && cross(d, second) * turn > 0) return d;
  return dot(d, first) >= dot(d, second) ? first : second;
}

inline Vec<3> in_plane(const Vec<2>& a) { return {{a[0], a[1], 0}}; }

}  // namespace crampon
