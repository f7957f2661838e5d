#pragma once
/// What a pair of fields in contact does when all others at its node are held (docs/theory/contact.md, impulses).

#include <cmath>

#include "crampon/contact/law.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// v without the components k for which bit k of axes is set.
template <int Dim>
Vec<Dim> without_axes(Vec<Dim> v, unsigned axes) {
  for (int k = 0; k < Dim; ++k) {
    if (axes >> k & 1u) v[k] = 0;
  }
  return v;
}

/// The impulse of one pair and the conditions from which it came: the normal part brings w_n to `target`, the tangential part stops all
/// slip or rubs.
template <int Dim>
struct Response {
  Vec<Dim> J;         ///< impulse on b, kg m/s
  double normal = 0;  ///< its part along n, kg m/s
  bool pushes = false, sticks = false;
  double target = 0;  ///< normal relative velocity that it leaves, m/s, when it pushes
  Vec<Dim> along;     ///< impulse on b per unit of its normal part, when it pushes: n and the friction that goes with it
  Vec<Dim> aside;     ///< the friction that does not go with it, kg m/s

  /// Brings w_n to `to`; m is the reduced mass.
  void push(const Vec<Dim>& n, double m, double w_n, double to) {
    pushes = true;
    target = to;
    along = n;
    normal = m * (to - w_n);
    J = n * normal;
  }
  /// D_t = m w_t, the impulse on a that stops all slip.
  void stick(const Vec<Dim>& D_t) {
    sticks = true;
    J -= D_t;
  }
  /// The law's share of the tangential impulse; of `sliding` mass, dt, area and slip are given.
  void rub(const ContactLaw& law, const Vec<Dim>& D_t, Sliding sliding) {
    sliding.normal = std::fabs(normal);
    sliding.full = norm(D_t);
    const SlidingLimit limit = law.limit(sliding);
    if (limit.sticks) return stick(D_t);
    if (limit.per_normal > 0) {
      const Vec<Dim> friction = D_t * (-std::copysign(limit.per_normal, normal) / sliding.full);
      along += friction;
      J += friction * normal;
    }
    if (limit.rest > 0) {
      aside = D_t * (-limit.rest / sliding.full);
      J += aside;
    }
  }
};

}  // namespace crampon
