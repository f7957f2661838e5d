#pragma once
/// Straight paths of the opening over one step, and the ellipses in which the coupled laws do no damage.

#include <algorithm>
#include <cmath>

#include "crampon/crack/traction/response.hpp"

namespace crampon {

inline double squared(double x) { return x * x; }

/// The opening a fraction s of the way.
inline PerMode opening_along(const PerMode& from, const PerMode& to, double s) {
  return {from.normal + s * (to.normal - from.normal), from.shear + s * (to.shear - from.shear)};
}

/// (u_n/r_n)^2 + (u_t/r_t)^2: 1 on the ellipse with half axes r; a mode that does not move has no part in it.
inline double ellipse_value(const PerMode& u, const PerMode& r) {
  return (u.normal == 0 ? 0 : squared(u.normal / r.normal)) + (u.shear == 0 ? 0 : squared(u.shear / r.shear));
}

/// Part of the normal mode in ellipse_value(u, r), 0 to 1; `other` where it is not defined, at the origin and for half axes of no length.
inline double normal_share(const PerMode& u, const PerMode& r, double other) {
  const double sum = ellipse_value(u, r);
  return sum > 0 && std::isfinite(sum) ? (u.normal == 0 ? 0 : squared(u.normal / r.normal)) / sum : other;
}

/// Where the path from a point inside the ellipse to one outside leaves it, as a fraction in [0, 1].
inline double leaves_ellipse(const PerMode& from, const PerMode& to, const PerMode& r) {
  if (r.normal <= 0 || r.shear <= 0) return 0;
  const PerMode d = {to.normal - from.normal, to.shear - from.shear};
  const double A = ellipse_value(d, r), C = ellipse_value(from, r) - 1;
  const double B = from.normal * d.normal / squared(r.normal) + from.shear * d.shear / squared(r.shear);
  if (C >= 0) return 0;
  const double root = std::sqrt(std::max(0., B * B - A * C));
  const double s = B > 0 ? -C / (B + root) : (root - B) / A;  // A s^2 + 2 B s + C = 0, without cancellation
  return s >= 0 && s <= 1 ? s : 1;
}

}  // namespace crampon
