#pragma once
#include <vector>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth to where the hoop stress is largest, when it is what K_Ic makes in pure opening (Erdogan and Sih, J. Basic Eng. 85 (1963)).
struct MaxHoopStress {
  double K_Ic = 0;  ///< Pa sqrt(m)

  static constexpr const char* name = "max_hoop_stress";
  static constexpr bool needs_intensities = true;
  static constexpr bool looks_ahead = false;
  static std::vector<MaxHoopStress> examples() { return {{1e6}, {68e6}}; }
  double drive(const TipState& tip) const {
    const double theta = angle(tip), half = std::cos(theta / 2);
    const double K = half * (tip.K.I * half * half - 1.5 * tip.K.II * std::sin(theta));
    return K > 0 ? K * K / (K_Ic * K_Ic) : 0.;
  }
  double angle(const TipState& tip) const { return hoop_angle(tip.K.I, tip.K.II); }
  double speed(const TipState&) const { return no_limit_of_speed; }
  static const Declaration<MaxHoopStress>& declaration() {
    static const auto d = Declaration<MaxHoopStress>(name, "Growth to where the hoop stress about the tip is largest.")
                              .quantity("K_Ic", &MaxHoopStress::K_Ic, "Pa m^(1/2)", Bounds::positive(),
                                        "K_I at which a crack under pure opening grows", Presence::required);
    return d;
  }
};

}  // namespace crampon
