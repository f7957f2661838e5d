#pragma once
#include <optional>
#include <vector>

#include "crampon/crack/criteria/criterion.hpp"

namespace crampon {

/// Growth when the faces are so far apart behind the tip, by opening or by sliding; straight on.
struct CriticalOpening {
  double opening = 0;             ///< m
  std::optional<double> sliding;  ///< m; none: sliding does not count

  static constexpr const char* name = "critical_opening";
  static constexpr bool needs_intensities = false;
  static constexpr bool looks_ahead = false;
  static std::vector<CriticalOpening> examples() { return {{1e-5, {}}, {1e-5, 2e-5}}; }
  double drive(const TipState& tip) const {
    const double opened = std::fmax(tip.opening[1], 0) / opening, slid = sliding ? std::fabs(tip.opening[0]) / *sliding : 0.;
    return std::pow(std::fmax(opened, slid), 2);  // openings go as the root of energy
  }
  double angle(const TipState&) const { return 0; }
  double speed(const TipState&) const { return no_limit_of_speed; }
  static const Declaration<CriticalOpening>& declaration() {
    static const auto d =
        Declaration<CriticalOpening>(name, "Growth when the faces are far enough apart, two cells behind the tip.")
            .quantity("opening", &CriticalOpening::opening, "m", Bounds::positive(), "at which the crack grows", Presence::required)
            .quantity("sliding", &CriticalOpening::sliding, "m", Bounds::positive(), "at which the crack grows, in either sense");
    return d;
  }
};

}  // namespace crampon
