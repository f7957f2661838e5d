#pragma once
/// What shape functions are along an axis, computed from the boxes that they say they are made of.

#include <cmath>

#include "crampon/shape/profile.hpp"

namespace crampon::test {

/// Value and slope at xi = (x_p - x_i)/h; l is the half size of the particle in cells.
struct Profile {
  double value = 0, slope = 0;
};

/// Boxes folded with each other, as a sum of truncated powers: what the members of the family say of themselves, computed without their weights.
inline Profile profile(const ProfileBoxes& boxes, double xi, double l) {
  if (boxes.ends > 0) {
    const ProfileBoxes without{boxes.cell, boxes.particle, boxes.ends - 1};
    const Profile low = profile(without, xi - l, l), high = profile(without, xi + l, l);
    // Functions of domains have the slope of what is linear between the ends.
    return {(low.value + high.value) / 2, (high.value - low.value) / (2 * l)};
  }
  const int count = boxes.cell + boxes.particle;
  double scale = 1;
  for (int b = 0; b < count; ++b) scale /= (b < boxes.cell ? 1 : 2 * l) * (b > 0 ? b : 1);
  Profile sum;
  for (int side = 0; side < 1 << count; ++side) {
    double at = -std::fabs(xi), sign = scale;
    for (int b = 0; b < count; ++b) {
      at += (side >> b & 1 ? -1 : 1) * (b < boxes.cell ? 0.5 : l);
      if (side >> b & 1) sign = -sign;
    }
    if (at <= 0) continue;
    sum.value += sign * std::pow(at, count - 1);
    sum.slope -= (xi < 0 ? -1 : 1) * sign * (count - 1) * std::pow(at, count - 2);
  }
  return sum;
}

}  // namespace crampon::test
