#pragma once
#include <cmath>

#include "crampon/crack/traction/peak_input.hpp"

namespace crampon {

/// S = 27/4 sigma_c s (1 - s)^2 with s = u/u_c: smooth, peak at u_c/3, damage from the start.
struct CubicCurve {
  double strength = 0;      ///< sigma_c, Pa
  double last_opening = 0;  ///< u_c, m

  double stiffness() const { return 6.75 * strength / last_opening; }
  double onset() const { return 0; }
  double final_opening() const { return last_opening; }
  double toughness() const { return 0.5625 * strength * last_opening; }
  double stress(double u) const {
    const double s = u / last_opening;
    return 6.75 * strength * s * (1 - s) * (1 - s);
  }
  double dissipated(double u) const {
    const double s = u / last_opening;
    return 6.75 * strength * last_opening * s * s * s * (1. / 3 - 0.25 * s);
  }
  double slope(double u) const {
    const double s = u / last_opening;
    return stiffness() * (1 - s) * (1 - 3 * s);
  }
  double opening_at(double intact) const { return last_opening * (1 - std::sqrt(intact)); }
};

struct CubicInput : PeakInput {
  static constexpr const char* name = "cubic";
  static CubicInput example();  ///< of a real crack, for tests
  static const Declaration<CubicInput>& declaration();
  CubicCurve curve() const;
};

}  // namespace crampon
