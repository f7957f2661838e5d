#pragma once
/// How long will a run take, and how strong a damping brings it to rest?

#include <cstdint>
#include <optional>
#include <string>

#include "crampon/run/simulation.hpp"

namespace crampon {

struct RunEstimate {
  std::int64_t steps_measured = 0;
  double seconds_per_step = 0;  ///< wall clock
  double seconds = 0;           ///< of the whole run, without writing its output
  std::string stopped;          ///< why the run could not go on within the measured steps; empty otherwise
};

/// Runs a few steps of a simulation (which is spent afterwards) for at most about `budget` wall seconds and extrapolates to the
/// planned number of steps. The first step, which also sorts the particles, is left out of the rate when there are others.
RunEstimate estimate_run(Simulation& simulation, double budget = 1);

/// The slowest swing of the bodies that are given by shapes.
struct SlowestSwing {
  std::string body;
  double frequency = 0;  ///< angular, 1/s
  /// Damping at which it just ceases to swing, 1/s: a = f/m - kappa v is critical at twice the angular frequency.
  double critical_damping() const { return 2 * frequency; }
};

/// Of every body the lower of two: a rod of its longest side held at one end, pi c/(2 L), and a cantilever of its longest and shortest side,
/// 1.015 c t/L^2, with c the wave speed of its material. How bodies are really held is not looked at: a factor of some units. Empty without a
/// body that has a shape.
std::optional<SlowestSwing> estimate_slowest_swing(const Problem& problem);

}  // namespace crampon
