#pragma once

#include <algorithm>

#include "crampon/core/vector.hpp"

namespace crampon {

/// Distance from x to the segment from a to b, m.
inline double distance_to_segment(const Vec<2>& x, const Vec<2>& a, const Vec<2>& b) {
  const Vec<2> along = b - a;
  const double length2 = dot(along, along);
  const double s = length2 > 0 ? std::clamp(dot(x - a, along) / length2, 0., 1.) : 0.;
  return norm(x - a - along * s);
}

}  // namespace crampon
