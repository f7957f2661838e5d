#pragma once
#include <vector>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth when J reaches the toughness, to where the hoop stress is largest; straight on where there is no K.
struct CriticalJ {
  double toughness = 0;  ///< J/m2

  static constexpr const char* name = "critical_j";
  static constexpr bool needs_intensities = false;
  static constexpr bool looks_ahead = false;
  static std::vector<CriticalJ> examples() { return {{100.}, {2.2e4}}; }
  double drive(const TipState& tip) const { return tip.J / toughness; }
  double angle(const TipState& tip) const { return tip.K.I == tip.K.I ? hoop_angle(tip.K.I, tip.K.II) : 0.; }
  double speed(const TipState&) const { return no_limit_of_speed; }
  static const Declaration<CriticalJ>& declaration() {
    static const auto d =
        Declaration<CriticalJ>(name, "Growth when J reaches the toughness.")
            .quantity("toughness", &CriticalJ::toughness, "J/m2", Bounds::positive(), "J at which the crack grows", Presence::required);
    return d;
  }
};

}  // namespace crampon
