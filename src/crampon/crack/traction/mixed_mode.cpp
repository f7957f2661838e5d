#include "crampon/crack/traction/mixed_mode.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crampon/crack/traction/curve.hpp"
#include "crampon/crack/traction/path.hpp"
#include "crampon/crack/traction/root.hpp"

namespace crampon {

namespace {

/// 1 - D of one mode loaded to u alone.
template <class Curve>
double intact_part(const Curve& curve, double u) {
  return u >= curve.final_opening() ? 0 : secant(curve, u) / curve.stiffness();
}

/// dI/du on the curve, 1/m.
template <class Curve>
double intact_slope(const Curve& curve, double intact, double u) {
  return (curve.slope(u) / curve.stiffness() - intact) / u;
}

/// The openings u_n(D), u_t(D) of the two curves at the damage for which u lies on their ellipse: the root of
/// f(D) = (u_n/u_n(D))^2 + (u_t/u_t(D))^2 - 1. Found as u_n(D) from 1/sqrt(f + 1) = 1, in which it is linear for curves of one shape.
template <class Normal, class Shear>
PerMode solve_damage(const Normal& normal, const Shear& shear, const PerMode& u, const PerMode& u_c) {
  if (u.shear == 0) return {u.normal, shear.opening_at(intact_part(normal, u.normal))};
  if (u.normal == 0) return {normal.opening_at(intact_part(shear, u.shear)), u.shear};
  PerMode r;
  const double low = std::min(std::max(u.normal, normal.opening_at(intact_part(shear, u.shear))), u_c.normal);  // one term is 1
  const double start = std::clamp(std::sqrt(ellipse_value(u, u_c)) * u_c.normal, low, u_c.normal);
  r.normal = find_root(low, u_c.normal, start, [&](double r_n) {
    const double intact = intact_part(normal, r_n), r_t = shear.opening_at(intact);
    const double n = squared(u.normal / r_n), t = squared(u.shear / r_t), root = std::sqrt(n + t);
    const double turn = intact_slope(normal, intact, r_n) / intact_slope(shear, intact, r_t);  // dr_t/dr_n
    return std::pair(1 / root - 1, (n / r_n + t / r_t * turn) / (root * (n + t)));
  });
  r.shear = shear.opening_at(intact_part(normal, r.normal));
  return r;
}

template <class Normal, class Shear>
Traction update(const Normal& normal, const Shear& shear, const PerMode& u, TractionHistory& history) {
  const PerMode u_c = {normal.final_opening(), shear.final_opening()};
  PerMode damaged = {std::max(history.largest_normal_opening, normal.onset()), std::max(history.largest_shear_opening, shear.onset())};
  if (ellipse_value(u, damaged) > 1) {
    const PerMode before = {history.normal_opening, history.shear_opening};
    const bool fails = ellipse_value(u, u_c) >= 1;
    PerMode next = u_c;
    if (!fails) {
      next = solve_damage(normal, shear, {u.normal, std::abs(u.shear)}, u_c);
      next = {std::clamp(next.normal, damaged.normal, u_c.normal), std::clamp(next.shear, damaged.shear, u_c.shear)};
    }
    // dG_I = k_n u_n^2 dD/2 = (u_n/u_n(D))^2 dPsi_n: exact for pure modes whatever the step.
    const PerMode end = fails ? opening_along(before, u, leaves_ellipse(before, u, u_c)) : u;
    const double end_share = normal_share(end, next, 0);
    const double start_share = normal_share(opening_along(before, u, leaves_ellipse(before, u, damaged)), damaged, end_share);
    const double share = 0.5 * (start_share + end_share);
    history.dissipated_normal += share * std::max(0., normal.dissipated(next.normal) - normal.dissipated(damaged.normal));
    history.dissipated_shear += (1 - share) * std::max(0., shear.dissipated(next.shear) - shear.dissipated(damaged.shear));
    history.largest_normal_opening = next.normal;
    history.largest_shear_opening = next.shear;
    history.damage = fails ? 1 : std::max(history.damage, 1 - intact_part(normal, next.normal));
    if (fails) {
      history.failed = 1;
      return {};
    }
    damaged = next;
  }
  Traction T{secant(normal, damaged.normal) * u.normal, secant(shear, damaged.shear) * u.shear, 0};
  T.stored = 0.5 * (T.normal * u.normal + T.shear * u.shear);
  return T;
}

}  // namespace

Traction MixedModeTraction::respond(const PerMode& opening, double, const Vec<3>&, TractionHistory& history) const {
  return std::visit([&](const auto& n, const auto& t) { return update(n, t, opening, history); }, normal, shear);
}

double MixedModeTraction::largest_stiffness() const {
  return std::visit([](const auto& n, const auto& t) { return std::max(n.stiffness(), t.stiffness()); }, normal, shear);
}

PerMode MixedModeTraction::toughness() const {
  return std::visit([](const auto& n, const auto& t) { return PerMode{n.toughness(), t.toughness()}; }, normal, shear);
}

const Family<SofteningCurve>& softening_curves() {
  static const auto make = [](const auto& in) { return SofteningCurve{in.curve()}; };
  static const auto family = Family<SofteningCurve>("softening curve", "curve", "Traction over opening in one mode.")
                                 .add(TriangularInput::declaration(), make)
                                 .add(TrilinearInput::declaration(), make)
                                 .add(CubicInput::declaration(), make)
                                 .add(ExponentialInput::declaration(), make);
  return family;
}

std::vector<MixedModeTraction> MixedModeTraction::examples() {
  return {{TriangularInput::example().curve(), CubicInput::example().curve()},
          {ExponentialInput::example().curve(), TrilinearInput::example().curve()}};
}

const Declaration<MixedModeTraction>& MixedModeTraction::declaration() {
  static const auto d =
      Declaration<MixedModeTraction>(
          name, "Any two curves, coupled by one damage variable; conserves energy on every path. The choice for mixed mode.")
          .one_of("normal", &MixedModeTraction::normal, softening_curves, "curve of pure opening", Presence::required)
          .one_of("shear", &MixedModeTraction::shear, softening_curves, "curve of pure sliding", Presence::required);
  return d;
}

}  // namespace crampon
