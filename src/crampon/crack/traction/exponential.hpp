#pragma once
#include "crampon/crack/traction/peak_input.hpp"

namespace crampon {

/// Elastic up to u_e, then S = sigma_c (exp(-a x) - exp(-a))/(1 - exp(-a)) with x = (u - u_e)/(u_c - u_e).
struct ExponentialCurve {
  double strength = 0;      ///< sigma_c, Pa
  double peak_opening = 0;  ///< u_e, m
  double last_opening = 0;  ///< u_c, m
  double decay = 1;         ///< a, dimensionless

  double stiffness() const { return strength / peak_opening; }
  double onset() const { return peak_opening; }
  double final_opening() const { return last_opening; }
  double toughness() const;
  double stress(double u) const;
  double dissipated(double u) const;
  double slope(double u) const;
  double opening_at(double intact) const;
};

struct ExponentialInput : ElasticPeakInput {
  double decay = 0;
  static constexpr const char* name = "exponential";
  static ExponentialInput example();  ///< of a real crack, for tests
  static const Declaration<ExponentialInput>& declaration();
  ExponentialCurve curve() const;
};

}  // namespace crampon
