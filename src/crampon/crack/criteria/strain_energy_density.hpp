#pragma once
#include <vector>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth to where the strain energy density about the tip is least, when it is what K_Ic makes in pure opening (Sih, Int. J. Fract. 10 (1974)).
struct StrainEnergyDensity {
  double K_Ic = 0;  ///< Pa sqrt(m)

  static constexpr const char* name = "strain_energy_density";
  static constexpr bool needs_intensities = true;
  static constexpr bool looks_ahead = false;
  static std::vector<StrainEnergyDensity> examples() { return {{1e6}, {68e6}}; }
  /// 16 pi mu r times the strain energy density.
  static double density(const TipState& tip, double theta) {
    const double c = std::cos(theta), s = std::sin(theta), kappa = tip.elastic.kappa;
    return (1 + c) * (kappa - c) * tip.K.I * tip.K.I + 2 * s * (2 * c - kappa + 1) * tip.K.I * tip.K.II +
           ((kappa + 1) * (1 - c) + (1 + c) * (3 * c - 1)) * tip.K.II * tip.K.II;
  }
  double drive(const TipState& tip) const {
    if (!(tip.K.I > 0) && tip.K.II == 0) return 0;
    return density(tip, angle(tip)) / (2 * (tip.elastic.kappa - 1) * K_Ic * K_Ic);
  }
  /// Where the density is least, against the sense of K_II. It falls off again towards the faces, behind a largest value: that is not meant.
  double angle(const TipState& tip) const {
    if (tip.K.II == 0) return 0;
    const double sense = tip.K.II > 0 ? -1 : 1;
    const auto along = [&](double way) { return density(tip, sense * way); };
    constexpr double step = std::numbers::pi / 360;
    double way = 0;
    while (way < 0.75 * std::numbers::pi && along(way + step) < along(way)) way += step;
    return sense * best_angle(std::fmax(way - step, 0), way + step, [&](double theta) { return -along(theta); });
  }
  double speed(const TipState&) const { return no_limit_of_speed; }
  static const Declaration<StrainEnergyDensity>& declaration() {
    static const auto d = Declaration<StrainEnergyDensity>(name, "Growth to where the strain energy density about the tip is least.")
                              .quantity("K_Ic", &StrainEnergyDensity::K_Ic, "Pa m^(1/2)", Bounds::positive(),
                                        "K_I at which a crack under pure opening grows", Presence::required);
    return d;
  }
};

}  // namespace crampon
