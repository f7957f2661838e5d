#pragma once
#include "crampon/crack/traction/peak_input.hpp"

namespace crampon {

/// Elastic up to the final opening, then nothing: all energy is released at once.
struct BrittleCurve {
  double strength = 0;      ///< sigma_c, Pa
  double last_opening = 0;  ///< u_c, m

  double stiffness() const { return strength / last_opening; }
  double onset() const { return last_opening; }
  double final_opening() const { return last_opening; }
  double toughness() const { return 0.5 * strength * last_opening; }
  double stress(double u) const { return stiffness() * u; }
  double dissipated(double) const { return 0; }
};

struct BrittleInput : PeakInput {
  static constexpr const char* name = "elastic_brittle";
  static BrittleInput example();  ///< of a real crack, for tests
  static const Declaration<BrittleInput>& declaration();
  BrittleCurve curve() const;
};

}  // namespace crampon
