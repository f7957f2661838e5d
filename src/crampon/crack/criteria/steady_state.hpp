#pragma once
#include <optional>
#include <vector>

#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth that begins when J reaches the toughness, or at a time, and goes straight on at one speed.
struct SteadyState {
  double toughness = 0;         ///< J/m2
  double constant_speed = 0;    ///< m/s
  std::optional<double> start;  ///< s; begins then at the latest

  static constexpr const char* name = "steady_state";
  static constexpr bool needs_intensities = false;
  static constexpr bool looks_ahead = false;
  static std::vector<SteadyState> examples() { return {{100., 300., {}}, {2.2e4, 1000., 1e-5}}; }
  double drive(const TipState& tip) const {
    if (tip.grown > 0 || (start && tip.time >= *start)) return std::fmax(1, tip.J / toughness);
    return tip.J / toughness;
  }
  double angle(const TipState&) const { return 0; }
  double speed(const TipState&) const { return constant_speed; }
  static const Declaration<SteadyState>& declaration() {
    static const auto d =
        Declaration<SteadyState>(name, "Growth straight on at one speed, once it has begun.")
            .quantity("toughness", &SteadyState::toughness, "J/m2", Bounds::positive(), "J at which growth begins", Presence::required)
            .quantity("speed", &SteadyState::constant_speed, "m/s", Bounds::positive(), "of the tip", Presence::required)
            .quantity("start", &SteadyState::start, "s", Bounds::non_negative(), "growth begins then at the latest");
    return d;
  }
};

}  // namespace crampon
