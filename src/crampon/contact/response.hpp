#pragma once
/// What a pair of fields in contact does when all others at its node are held (contact.md section 3).

#include <cmath>
#include <variant>

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
/// slip or rubs in proportion to the normal part.
template <int Dim>
struct Response {
  Vec<Dim> J;         ///< impulse on b, kg m/s
  double normal = 0;  ///< its part along n, kg m/s
  bool pushes = false, sticks = false;
  double target = 0;  ///< normal relative velocity that it leaves, m/s, when it pushes
  Vec<Dim> along;     ///< impulse on b per unit of its normal part, when it pushes: n and the friction that goes with it

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
  /// The law's share of the tangential impulse (contact.md 3, 4).
  void rub(const ContactLawSpec& law, const Vec<Dim>& D_t) {
    const auto* coulomb = std::get_if<CoulombContact>(&law);
    if (!coulomb && !std::holds_alternative<StickContact>(law)) return;
    const double full = norm(D_t);
    if (!coulomb || coulomb->friction * std::fabs(normal) >= full) return stick(D_t);
    const Vec<Dim> friction = D_t * (-std::copysign(coulomb->friction, normal) / full);
    along += friction;
    J += friction * normal;
  }
};

}  // namespace crampon
