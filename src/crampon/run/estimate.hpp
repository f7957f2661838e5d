#pragma once
/// How long will a run take?

#include <cstdint>
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

}  // namespace crampon
