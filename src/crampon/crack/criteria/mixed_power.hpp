#pragma once
#include <vector>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth when (K_I/K_Ic)^p + (K_II/K_IIc)^q = 1, to where the hoop stress is largest. Faces that press on each other have no K_I.
struct MixedPower {
  double K_Ic = 0, K_IIc = 0;  ///< Pa sqrt(m)
  double p = 2, q = 2;

  static constexpr const char* name = "mixed_power";
  static constexpr bool needs_intensities = true;
  static constexpr bool looks_ahead = false;
  static std::vector<MixedPower> examples() { return {{1e6, 0.8e6, 2, 2}, {68e6, 100e6, 1, 1.5}}; }
  /// The square of the factor by which K may grow for each that it takes to the curve.
  double drive(const TipState& tip) const {
    const double I = std::fmax(tip.K.I, 0) / K_Ic, II = std::fabs(tip.K.II) / K_IIc;
    const double largest = std::fmax(I, II);
    if (!(largest > 0)) return 0;
    double low = largest, high = 2 * (I + II) + largest;  // s with (I/s)^p + (II/s)^q = 1
    while (std::pow(I / high, p) + std::pow(II / high, q) > 1) high *= 2;
    while (std::pow(I / low, p) + std::pow(II / low, q) < 1) low *= 0.5;
    for (int i = 0; i < 100; ++i) {
      const double s = 0.5 * (low + high);
      (std::pow(I / s, p) + std::pow(II / s, q) > 1 ? low : high) = s;
    }
    return high * high;
  }
  double angle(const TipState& tip) const { return hoop_angle(std::fmax(tip.K.I, 0), tip.K.II); }
  double speed(const TipState&) const { return no_limit_of_speed; }
  static const Declaration<MixedPower>& declaration() {
    static const auto d =
        Declaration<MixedPower>(name, "Growth when (K_I/K_Ic)^p + (K_II/K_IIc)^q reaches 1.")
            .quantity("K_Ic", &MixedPower::K_Ic, "Pa m^(1/2)", Bounds::positive(), "K_I at which pure opening grows", Presence::required)
            .quantity("K_IIc", &MixedPower::K_IIc, "Pa m^(1/2)", Bounds::positive(), "K_II at which pure sliding grows", Presence::required)
            .quantity("p", &MixedPower::p, "1", Bounds::between(0.5, 10), "exponent of opening")
            .quantity("q", &MixedPower::q, "1", Bounds::between(0.5, 10), "exponent of sliding");
    return d;
  }
};

}  // namespace crampon
