#pragma once
#include <vector>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth when the largest principal stress ahead of the tip reaches the strength, across that stress. The stress is a mean over particles ahead.
struct MaxPrincipalStress {
  double strength = 0;  ///< Pa

  static constexpr const char* name = "max_principal_stress";
  static constexpr bool needs_intensities = false;
  static constexpr bool looks_ahead = true;
  static std::vector<MaxPrincipalStress> examples() { return {{1e7}, {5e8}}; }
  static double largest(const Tensor2& s) {
    return 0.5 * (s[0][0] + s[1][1]) + std::hypot(0.5 * (s[0][0] - s[1][1]), 0.5 * (s[0][1] + s[1][0]));
  }
  double drive(const TipState& tip) const {
    if (!tip.ahead) return 0;
    const double ratio = largest(*tip.ahead) / strength;
    return ratio > 0 ? ratio * ratio : 0;  // stress goes as the root of energy
  }
  double angle(const TipState& tip) const {
    if (!tip.ahead) return 0;
    const Tensor2& s = *tip.ahead;
    // The other principal direction, which differs by a quarter turn: that within a quarter turn of the direction of the crack.
    const double of_largest = 0.5 * std::atan2(s[0][1] + s[1][0], s[0][0] - s[1][1]);
    return of_largest > 0 ? of_largest - std::numbers::pi / 2 : of_largest + std::numbers::pi / 2;
  }
  double speed(const TipState&) const { return no_limit_of_speed; }
  static const Declaration<MaxPrincipalStress>& declaration() {
    static const auto d =
        Declaration<MaxPrincipalStress>(name, "Growth across the largest principal stress ahead of the tip.")
            .quantity("strength", &MaxPrincipalStress::strength, "Pa", Bounds::positive(),
                      "of the mean stress over some three cells ahead of the tip: it depends on the size of cells", Presence::required);
    return d;
  }
};

}  // namespace crampon
