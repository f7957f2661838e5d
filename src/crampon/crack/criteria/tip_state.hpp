#pragma once
#include <limits>
#include <optional>

#include "crampon/crack/stress_intensity.hpp"

namespace crampon {

/// What a criterion may ask of a tip. Directions are those of its frame: the first axis goes on from the crack, the second is to the left of it.
struct TipState {
  double J = 0;                  ///< J/m2
  StressIntensity K;             ///< Pa sqrt(m); not a number where there is none
  Vec<2> opening;                ///< {sliding, opening} of the left side behind the tip, m
  PlaneElasticity elastic;       ///< of the material about the tip
  double time = 0;               ///< s
  double grown = 0;              ///< since the start, m
  std::optional<Tensor2> ahead;  ///< mean stress ahead of the tip, Pa; where a criterion asks for it
};

inline constexpr double no_limit_of_speed = std::numeric_limits<double>::infinity();

}  // namespace crampon
