#pragma once
#include <vector>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth at the speed at which the tip takes what comes: v = v_max (1 - toughness/J) (Freund, Dynamic Fracture Mechanics, sec. 7.4).
struct EnergyDrivenGrowth {
  double toughness = 0;      ///< J/m2
  double largest_speed = 0;  ///< m/s

  static constexpr const char* name = "energy_balance";
  static constexpr bool needs_intensities = false;
  static constexpr bool looks_ahead = false;
  static std::vector<EnergyDrivenGrowth> examples() { return {{100., 300.}, {2.2e4, 2800.}}; }
  double drive(const TipState& tip) const { return tip.J / toughness; }
  double angle(const TipState& tip) const { return tip.K.I == tip.K.I ? hoop_angle(tip.K.I, tip.K.II) : 0.; }
  double speed(const TipState& tip) const { return tip.J > toughness ? largest_speed * (1 - toughness / tip.J) : 0.; }
  static const Declaration<EnergyDrivenGrowth>& declaration() {
    static const auto d =
        Declaration<EnergyDrivenGrowth>(name, "Growth at the speed at which the tip takes the energy that comes.")
            .quantity("toughness", &EnergyDrivenGrowth::toughness, "J/m2", Bounds::positive(), "energy that growth takes for each area",
                      Presence::required)
            .quantity("largest_speed", &EnergyDrivenGrowth::largest_speed, "m/s", Bounds::positive(),
                      "that the tip comes near under a very large J: the speed of Rayleigh waves, or what tests show", Presence::required);
    return d;
  }
};

}  // namespace crampon
