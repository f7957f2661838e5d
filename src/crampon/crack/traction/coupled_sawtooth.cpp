#include "crampon/crack/traction/coupled_sawtooth.hpp"

#include <algorithm>

#include "crampon/crack/traction/path.hpp"

namespace crampon {

Traction CoupledSawtooth::respond(const PerMode& u, double, const Vec<3>&, TractionHistory& history) const {
  const PerMode u_c = {normal.last_opening, shear.last_opening}, u_p = {normal.peak_opening, shear.peak_opening};
  // Effective opening, and where its peak is in the direction of u: lambda_p(theta).
  const auto effective = [&](const PerMode& v) { return std::sqrt(ellipse_value(v, u_c)); };
  const auto peak = [&](const PerMode& v) { return std::sqrt(ellipse_value(v, u_c) / ellipse_value(v, u_p)); };
  const double lambda = effective(u), lambda_m = history.damage;
  history.largest_normal_opening = std::max(history.largest_normal_opening, u.normal);
  history.largest_shear_opening = std::max(history.largest_shear_opening, std::abs(u.shear));
  if (lambda == 0) return {};

  if (lambda > lambda_m && ellipse_value(u, u_p) > 1) {
    const PerMode before = {history.normal_opening, history.shear_opening};
    const PerMode damaged = {lambda_m * u_c.normal, lambda_m * u_c.shear};
    const bool fails = lambda >= 1;
    const double s0 = std::max(leaves_ellipse(before, u, u_p), leaves_ellipse(before, u, damaged));
    const PerMode start = opening_along(before, u, s0), end = fails ? opening_along(before, u, leaves_ellipse(before, u, u_c)) : u;
    const double end_share = normal_share(end, u_c, 0), start_share = normal_share(start, u_c, end_share);
    const double end_peak = peak(end), start_peak = ellipse_value(start, u_c) > 0 ? peak(start) : end_peak;
    history.damage = fails ? 1 : lambda;
    // dG_I = G_Ic sin^2 theta d lambda_m/(1 - lambda_p), dG_II likewise with the cosine.
    const double change = std::max(0., history.damage - std::max(lambda_m, start_peak));
    const auto mean = [&](double at_start, double at_end) {
      return 0.5 * change * (at_start / (1 - start_peak) + at_end / (1 - end_peak));
    };
    history.dissipated_normal += normal.toughness() * mean(start_share, end_share);
    history.dissipated_shear += shear.toughness() * mean(1 - start_share, 1 - end_share);
    if (fails) {
      history.failed = 1;
      return {};
    }
  }

  const double lambda_p = peak(u), m = history.damage;
  const double softening = m > lambda_p ? (1 - m) / ((1 - lambda_p) * m) : 1 / lambda_p;  // H/lambda_m, never stiffer than 1/lambda_p
  Traction T{normal.strength * softening * u.normal / u_c.normal, shear.strength * softening * u.shear / u_c.shear, 0};
  T.stored = 0.5 * (T.normal * u.normal + T.shear * u.shear);
  return T;
}

double CoupledSawtooth::largest_stiffness() const {
  const double lambda_p = std::min(normal.peak_opening / normal.last_opening, shear.peak_opening / shear.last_opening);
  return std::max(normal.strength / normal.last_opening, shear.strength / shear.last_opening) / lambda_p;
}

const Declaration<CoupledSawtoothInput>& CoupledSawtooth::declaration() {
  static const auto d =
      Declaration<Input>(
          name,
          "Triangular over one effective opening. Conserves energy on curved paths only if peak_opening/final_opening is the "
          "same for both modes; otherwise prefer mixed_mode.")
          .record("normal", &Input::normal, TriangularInput::declaration, "curve of pure opening", Presence::required)
          .record("shear", &Input::shear, TriangularInput::declaration, "curve of pure sliding", Presence::required);
  return d;
}

}  // namespace crampon
