#pragma once
#include "crampon/crack/traction/peak_input.hpp"

namespace crampon {

/// Three straight pieces through (u1, sigma1), (u2, sigma2) and (u_c, 0).
struct TrilinearCurve {
  double strength = 0;      ///< sigma1, Pa
  double peak_opening = 0;  ///< u1, m
  double knee_stress = 0;   ///< sigma2, Pa; sigma2/u2 < sigma1/u1
  double knee_opening = 0;  ///< u2, m
  double last_opening = 0;  ///< u_c, m

  double stiffness() const { return strength / peak_opening; }
  double onset() const { return peak_opening; }
  double final_opening() const { return last_opening; }
  double toughness() const { return 0.5 * (strength * knee_opening + knee_stress * (last_opening - peak_opening)); }
  double slope(double u) const {
    return u < knee_opening ? (knee_stress - strength) / (knee_opening - peak_opening) : -knee_stress / (last_opening - knee_opening);
  }
  double stress(double u) const;
  double dissipated(double u) const;
  double opening_at(double intact) const;
};

struct TrilinearInput : ElasticPeakInput {
  double knee_stress = 0, knee_opening = 0;
  static constexpr const char* name = "trilinear";
  static TrilinearInput example();  ///< of a real crack, for tests
  static const Declaration<TrilinearInput>& declaration();
  TrilinearCurve curve() const;
};

}  // namespace crampon
