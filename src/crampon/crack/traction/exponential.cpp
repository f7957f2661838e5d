#include "crampon/crack/traction/exponential.hpp"

#include <cmath>
#include <utility>

#include "crampon/crack/traction/curve.hpp"
#include "crampon/crack/traction/root.hpp"

namespace crampon {

namespace {

/// Area under the falling part for a strength of 1 and a length of 1: 1/a - 1/(exp(a) - 1).
double falling_area(double a) { return 1 / a - 1 / std::expm1(a); }

}  // namespace

double ExponentialCurve::toughness() const { return strength * (0.5 * peak_opening + (last_opening - peak_opening) * falling_area(decay)); }

double ExponentialCurve::stress(double u) const {
  if (u <= peak_opening) return stiffness() * u;
  const double y = (last_opening - u) / (last_opening - peak_opening);  // 1 - x; the numerator is exp(-a x)(1 - exp(-a y))
  return strength * std::exp(-decay * (1 - y)) * std::expm1(-decay * y) / std::expm1(-decay);
}

double ExponentialCurve::dissipated(double u) const {
  if (u <= peak_opening) return 0;
  if (u >= last_opening) return toughness();
  const double L = last_opening - peak_opening, x = (u - peak_opening) / L;
  const double area = (std::expm1(-decay * x) / decay + x * std::exp(-decay)) / std::expm1(-decay);
  return dissipated_of(strength * (0.5 * peak_opening + L * area), stress(u), u);
}

double ExponentialCurve::slope(double u) const {
  const double L = last_opening - peak_opening;
  return strength * decay / L * std::exp(-decay * (u - peak_opening) / L) / std::expm1(-decay);
}

double ExponentialCurve::opening_at(double intact) const {
  if (intact <= 0) return last_opening;
  // I (u_e + L x)/u_e = S/sigma_c
  const double L = last_opening - peak_opening, b = intact * L / peak_opening, all = -std::expm1(-decay);
  const double x = find_root(0., 1., 0.5, [&](double s) {
    const double left = std::exp(-decay * s) / all;
    return std::pair(intact + b * s + left * std::expm1(-decay * (1 - s)), b + decay * left);
  });
  return peak_opening + L * x;
}

ExponentialCurve ExponentialInput::curve() const {
  ExponentialCurve c{.decay = decay};
  const double m = falling_area(decay);
  // G_c = sigma_c (u_e/2 + (u_c - u_e) m); with u_e = sigma_c/k quadratic in sigma_c.
  if (strength) {
    c.strength = *strength;
  } else if (peak_opening) {
    c.strength = *toughness / (0.5 * *peak_opening + (*final_opening - *peak_opening) * m);
  } else {
    const double b = m * *final_opening;
    c.strength = 2 * *toughness / (b + std::sqrt(b * b + 4 * *toughness * (0.5 - m) / *stiffness));
  }
  c.peak_opening = peak_opening ? *peak_opening : c.strength / *stiffness;
  c.last_opening = final_opening ? *final_opening : c.peak_opening + (*toughness / c.strength - 0.5 * c.peak_opening) / m;
  return c;
}

ExponentialInput ExponentialInput::example() {
  ExponentialInput in;
  in.strength = 5e6, in.toughness = 300, in.peak_opening = 1e-5, in.decay = 4;
  return in;
}

const Declaration<ExponentialInput>& ExponentialInput::declaration() {
  static const auto d =
      with_elastic_peak(Declaration<ExponentialInput>(name, "Straight up to the strength, exponential decay that ends at nothing."))
          .quantity("decay", &ExponentialInput::decay, "1", Bounds::between(1e-3, 50),
                    "exponent of the decay over the whole falling part; near 0 the curve is triangular", Presence::required)
          .check([](const ExponentialInput& in, Diagnostics& diagnostics) {
            if (!check_peak(in, diagnostics)) return;
            // A given peak beyond the final opening would make sense of neither strength nor toughness.
            if (in.peak_opening && in.final_opening &&
                !check_order("opening at the peak", *in.peak_opening, "final opening", *in.final_opening, diagnostics))
              return;
            const ExponentialCurve c = in.curve();
            check_order("opening at the peak", c.peak_opening, "final opening", c.last_opening, diagnostics);
          });
  return d;
}

}  // namespace crampon
