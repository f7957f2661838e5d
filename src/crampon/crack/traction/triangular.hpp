#pragma once
#include "crampon/crack/traction/peak_input.hpp"

namespace crampon {

/// Up in a straight line, down in a straight line (sawtooth).
struct TriangularCurve {
  double strength = 0;      ///< sigma_c, Pa
  double peak_opening = 0;  ///< u_p, m
  double last_opening = 0;  ///< u_c, m

  double stiffness() const { return strength / peak_opening; }
  double onset() const { return peak_opening; }
  double final_opening() const { return last_opening; }
  double toughness() const { return 0.5 * strength * last_opening; }
  double stress(double u) const {
    return u <= peak_opening ? stiffness() * u : strength * (last_opening - u) / (last_opening - peak_opening);
  }
  double dissipated(double u) const { return u <= peak_opening ? 0 : toughness() * (u - peak_opening) / (last_opening - peak_opening); }
  double slope(double) const { return -strength / (last_opening - peak_opening); }
  double opening_at(double intact) const { return peak_opening * last_opening / (peak_opening + intact * (last_opening - peak_opening)); }
};

struct TriangularInput : ElasticPeakInput {
  static constexpr const char* name = "triangular";
  static TriangularInput example();  ///< of a real crack, for tests
  static const Declaration<TriangularInput>& declaration();
  TriangularCurve curve() const;
};

}  // namespace crampon
