#pragma once
#include <vector>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth to where a small kink would release most energy, when that is the toughness. Intensities of the kink to first order
/// (Nuismer, Int. J. Fract. 11 (1975)).
struct MaxEnergyRelease {
  double toughness = 0;  ///< J/m2

  static constexpr const char* name = "max_energy_release";
  static constexpr bool needs_intensities = true;
  static constexpr bool looks_ahead = false;
  static std::vector<MaxEnergyRelease> examples() { return {{100.}, {2.2e4}}; }
  /// Of a kink at an angle, J/m2.
  static double release(const TipState& tip, double theta) {
    const double c1 = std::cos(theta / 2), c3 = std::cos(1.5 * theta), s1 = std::sin(theta / 2), s3 = std::sin(1.5 * theta);
    const double I = 0.25 * (3 * c1 + c3) * tip.K.I - 0.75 * (s1 + s3) * tip.K.II;
    const double II = 0.25 * (s1 + s3) * tip.K.I + 0.25 * (c1 + 3 * c3) * tip.K.II;
    return (std::fmax(I, 0) * std::fmax(I, 0) + II * II) / tip.elastic.modulus;
  }
  double drive(const TipState& tip) const { return release(tip, angle(tip)) / toughness; }
  double angle(const TipState& tip) const {
    if (tip.K.II == 0) return 0;
    const double away = 0.75 * std::numbers::pi, low = tip.K.II > 0 ? -away : 0, high = tip.K.II > 0 ? 0 : away;
    return best_angle(low, high, [&](double theta) { return release(tip, theta); });
  }
  double speed(const TipState&) const { return no_limit_of_speed; }
  static const Declaration<MaxEnergyRelease>& declaration() {
    static const auto d = Declaration<MaxEnergyRelease>(name, "Growth to where a small kink would release most energy.")
                              .quantity("toughness", &MaxEnergyRelease::toughness, "J/m2", Bounds::positive(),
                                        "energy release at which the crack grows", Presence::required);
    return d;
  }
};

}  // namespace crampon
