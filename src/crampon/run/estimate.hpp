#pragma once
/// How long will a run take, and how strong a damping brings it to rest?

#include <cmath>
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

/// The slowest free vibrations of a body as if it were held at one end of its longest side: angular frequencies, 1/s.
struct SlowestSwing {
  std::string body;
  double along = 0;    ///< of a rod, pi c/(2 L), with c the wave speed of its material
  double bending = 0;  ///< of a cantilever as thick as its shortest side t, 1.015 c t/L^2
  double frequency() const { return std::fmin(along, bending); }
};

/// Damping at which a vibration just ceases to swing, 1/s: a = f/m - kappa v is critical at twice the angular frequency.
constexpr double critical_damping(double frequency) { return 2 * frequency; }

/// Of the body that swings the slowest; shapes are taken for their boxes, and how bodies are really held is not looked at. Empty without a body
/// that has a shape.
std::optional<SlowestSwing> estimate_slowest_swing(const Problem& problem);

}  // namespace crampon
