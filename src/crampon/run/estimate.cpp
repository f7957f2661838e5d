#include "crampon/run/estimate.hpp"

#include <chrono>
#include <limits>

namespace crampon {

RunEstimate estimate_run(Simulation& simulation, double budget) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); };
  constexpr std::int64_t most_steps = 50;  // enough for a rate where steps take microseconds

  RunEstimate estimate;
  const std::int64_t planned = simulation.size().steps;
  const Clock::time_point start = Clock::now();
  double first = 0;
  double total = 0;
  while (!simulation.finished() && estimate.steps_measured < most_steps && total < budget) {
    try {
      simulation.step(std::numeric_limits<double>::infinity());
    } catch (const RunError& error) {
      estimate.stopped = error.what();
      break;
    }
    total = seconds_since(start);
    if (++estimate.steps_measured == 1) first = total;
  }
  if (estimate.steps_measured > 1)
    estimate.seconds_per_step = (total - first) / static_cast<double>(estimate.steps_measured - 1);
  else
    estimate.seconds_per_step = first;
  estimate.seconds = estimate.seconds_per_step * static_cast<double>(planned);
  return estimate;
}

}  // namespace crampon
