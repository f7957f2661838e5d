#pragma once
/// Orientation of three points in the plane, exact in sign (docs/theory/crossing.md, orientation).
///
/// Exact for finite coordinates that are zero or of magnitude 1e-140 to 1e140: then no product of coordinate differences overflows,
/// and all are multiples of the smallest positive double, so nothing is lost to underflow. Needs contraction off (the build's
/// flags see to that): a fused a*b - c*d does not cancel exactly.

#include <cmath>

#include "crampon/core/vector.hpp"

namespace crampon {

/// The same sign as orient_sign, by exact arithmetic alone: the slow path when rounding could decide.
int orient_sign_exact(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c);

/// Sign (-1, 0, 1) of (b - a) x (c - a): +1 when c lies to the left of the directed line a -> b, 0 when the three are collinear.
inline int orient_sign(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]);
  const double right = (b[1] - a[1]) * (c[0] - a[0]);
  const double determinant = left - right;
  // Two differences and a product of relative error u = 2^-53 each, and the last subtraction: at most (3u + O(u^2))(|left| + |right|)
  // (J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997, section 4.3); 3.34e-16 covers the higher orders.
  const double bound = 3.34e-16 * (std::fabs(left) + std::fabs(right));
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  // A product is zero only when a difference is, and a difference only when the coordinates are equal.
  if (left == 0 && right == 0) return 0;
  return orient_sign_exact(a, b, c);
}

/// orient_sign(a, b, n) with the node n moved to n + (eps, eps^2), eps -> 0+: when the determinant vanishes, the sign of its
/// derivative by n_x, and when that vanishes too, by n_y. Zero only for a = b.
/// Other positions of n follow by exchange: orient(a, n, b) = -orient(a, b, n).
inline int orient_sign_perturbed(const Vec<2>& a, const Vec<2>& b, const Vec<2>& n) {
  if (const int sign = orient_sign(a, b, n); sign != 0) return sign;
  if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
  return b[0] > a[0] ? 1 : b[0] < a[0] ? -1 : 0;
}

}  // namespace crampon
