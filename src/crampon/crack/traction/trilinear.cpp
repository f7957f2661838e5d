#include "crampon/crack/traction/trilinear.hpp"

#include <fmt/format.h>

#include "crampon/crack/traction/curve.hpp"

namespace crampon {

double TrilinearCurve::stress(double u) const {
  if (u <= peak_opening) return stiffness() * u;
  return u < knee_opening ? strength + slope(u) * (u - peak_opening) : slope(u) * (u - last_opening);
}

double TrilinearCurve::dissipated(double u) const {
  if (u <= peak_opening) return 0;
  if (u >= last_opening) return toughness();
  const double S = stress(u);
  const double work =
      u < knee_opening ? 0.5 * (strength * peak_opening + (strength + S) * (u - peak_opening)) : toughness() - 0.5 * S * (last_opening - u);
  return dissipated_of(work, S, u);
}

double TrilinearCurve::opening_at(double intact) const {
  // On a piece S = c + b u: the secant I k meets it at u = c/(I k - b).
  const double k = intact * stiffness();
  if (k * knee_opening >= knee_stress) {
    const double b = slope(peak_opening);
    return (strength - b * peak_opening) / (k - b);
  }
  const double b = slope(knee_opening);
  return b * last_opening / (b - k);
}

TrilinearCurve TrilinearInput::curve() const {
  TrilinearCurve c{.knee_stress = knee_stress, .knee_opening = knee_opening};
  // 2 G_c = sigma1 u2 + sigma2 (u_c - u1), with u1 = sigma1/k where k is given.
  if (strength)
    c.strength = *strength;
  else if (peak_opening)
    c.strength = (2 * *toughness - knee_stress * (*final_opening - *peak_opening)) / knee_opening;
  else
    c.strength = (2 * *toughness - knee_stress * *final_opening) / (knee_opening - knee_stress / *stiffness);
  c.peak_opening = peak_opening ? *peak_opening : c.strength / *stiffness;
  c.last_opening = final_opening ? *final_opening : c.peak_opening + (2 * *toughness - c.strength * knee_opening) / knee_stress;
  return c;
}

TrilinearInput TrilinearInput::example() {
  TrilinearInput in;
  in.strength = 5e6, in.final_opening = 1e-4, in.peak_opening = 1e-5, in.knee_stress = 1.5e6, in.knee_opening = 4e-5;
  return in;
}

const Declaration<TrilinearInput>& TrilinearInput::declaration() {
  static const auto d =
      with_elastic_peak(Declaration<TrilinearInput>(name, "Three straight pieces: up to the strength, to a knee, and to nothing."))
          .quantity("knee_stress", &TrilinearInput::knee_stress, "Pa", Bounds::positive(), "traction at the knee", Presence::required)
          .quantity("knee_opening", &TrilinearInput::knee_opening, "m", Bounds::positive(), "opening at the knee", Presence::required)
          .check([](const TrilinearInput& in, Diagnostics& diagnostics) {
            if (!check_peak(in, diagnostics)) return;
            const TrilinearCurve c = in.curve();
            if (!(c.strength > 0)) {
              diagnostics.add("toughness", "the toughness leaves no strength", fmt::format("the strength would be {:g} Pa", c.strength),
                              "make it tougher, or final_opening smaller");
              return;
            }
            if (!check_order("opening at the peak", c.peak_opening, "opening at the knee", c.knee_opening, diagnostics) ||
                !check_order("opening at the knee", c.knee_opening, "final opening", c.last_opening, diagnostics))
              return;
            if (!(c.knee_stress / c.knee_opening < c.stiffness()))
              diagnostics.add(
                  "knee_stress", "the knee is not below the elastic line",
                  fmt::format("{:g} Pa/m from the origin, and {:g} Pa/m to the peak", c.knee_stress / c.knee_opening, c.stiffness()),
                  "reduce knee_stress or increase knee_opening");
          });
  return d;
}

}  // namespace crampon
