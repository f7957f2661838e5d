#pragma once
/// Directions of angles, with whole quarter turns exact: cracks and symmetry planes sit on grid lines, where 1e-17 is a different side.

#include <cmath>
#include <numbers>

#include "crampon/core/vector.hpp"

namespace crampon {

/// (cos, sin) of an angle (rad). Within round-off of a multiple of 90 degrees the result is exactly 0 and +-1.
inline Vec<2> direction_of(double angle) {
  const double quarters = std::round(angle / (std::numbers::pi / 2));
  // Two roundings (unit conversion, product with pi) of half an ulp each, relative to the angle, plus that of pi itself.
  if (std::abs(angle - quarters * (std::numbers::pi / 2)) <= 4e-16 * std::fmax(1., std::abs(angle))) {
    const Vec<2> exact[4] = {{{1, 0}}, {{0, 1}}, {{-1, 0}}, {{0, -1}}};
    const int k = static_cast<int>(std::fmod(quarters, 4.));
    return exact[k < 0 ? k + 4 : k];
  }
  return {{std::cos(angle), std::sin(angle)}};
}

}  // namespace crampon
