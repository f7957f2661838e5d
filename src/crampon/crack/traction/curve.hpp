#pragma once
/// What the laws ask of a curve S of traction over opening in one mode (docs/theory/traction.md). A curve is a small value type with
///   stiffness()       k, Pa/m: slope at no opening
///   onset()           m: up to it S = k u, without damage
///   final_opening()   u_c, m
///   toughness()       G_c, J/m2: area under S
///   stress(u)         S, Pa, for u in [0, u_c]
///   dissipated(u)     Psi = W - S u/2, J/m2, for u in [0, u_c]: what cannot be had back after unloading from u
/// and, where it may take part in mixed_mode,
///   slope(u)          dS/du, Pa/m, for u in [onset, u_c]
///   opening_at(I)     the largest u for which S = I k u, for an intact part I = 1 - D in [0, 1].
/// S/u never rises, so that damage and dissipation never fall.

namespace crampon {

/// S/u, Pa/m: the stiffness of unloading from u.
template <class Curve>
double secant(const Curve& curve, double u) {
  return u <= curve.onset() ? curve.stiffness() : curve.stress(u) / u;
}

/// Psi from the work W under the curve.
inline double dissipated_of(double work, double stress, double u) {
  const double psi = work - 0.5 * stress * u;
  return psi > 0 ? psi : 0;
}

}  // namespace crampon
