#pragma once
/// How a crack may grow (docs/theory/fracture.md, growth).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/crack/criteria/criterion.hpp"
#include "crampon/state/fracture.hpp"

namespace crampon {

/// Where a tip grows to: as its criterion says, or otherwise.
enum class GrowthDirection { criterion, straight, across_opening, hoop_of_opening, initial, given };

/// What growth takes, over what it takes at first, as energy.
struct Resistance {
  std::vector<double> grown, factor;  ///< R-curve: m, 1; straight between, constant beyond
  double speed = 0, exponent = 1;     ///< 1 + (v/speed)^exponent, m/s; speed 0: it does not depend on the speed

  double at(double length, double v) const {
    double r = 1;
    if (!grown.empty()) {
      const auto beyond = static_cast<std::size_t>(std::upper_bound(grown.begin(), grown.end(), length) - grown.begin());
      if (beyond == 0) {
        r = factor.front();
      } else if (beyond == grown.size()) {
        r = factor.back();
      } else {
        const double s = (length - grown[beyond - 1]) / (grown[beyond] - grown[beyond - 1]);
        r = factor[beyond - 1] * (1 - s) + factor[beyond] * s;
      }
    }
    return speed > 0 ? r * (1 + std::pow(v / speed, exponent)) : r;
  }
};

struct GrowthModel {
  GrowthCriterionSpec criterion;        ///< empty: the crack does not grow
  GrowthCriterionSpec alternate;        ///< holds as well until the first has let a tip grow
  std::array<bool, 2> end{true, true};  ///< of the start and the end: may it grow?
  GrowthDirection direction = GrowthDirection::criterion;
  Vec<2> along;                                                     ///< given
  double increment = 0;                                             ///< m
  double largest_speed = 0;                                         ///< m/s
  bool by_rate = false;                                             ///< v = largest_speed (1 - 1/drive)
  double largest_growth = std::numeric_limits<double>::infinity();  ///< m
  double start = 0;                                                 ///< s
  double interval = 0;                                              ///< between two looks at a tip that does not grow, s
  double release = 0;                                               ///< length of path over which new faces come free behind a tip, m
  bool bridged = false;                                             ///< the traction law of the crack acts on what grows
  Resistance resistance;

  bool acts() const { return static_cast<bool>(criterion); }
};

inline bool may_grow(const CrackTip& tip, const GrowthModel& growth) {
  return growth.acts() && growth.end[tip.end] && (tip.status == TipStatus::waits || tip.status == TipStatus::grows);
}

}  // namespace crampon
