#include "crampon/run/estimate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

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

std::optional<SlowestSwing> estimate_slowest_swing(const Problem& problem) {
  const StressState state = problem.analysis == Analysis::plane_strain   ? StressState::plane_strain
                            : problem.analysis == Analysis::plane_stress ? StressState::plane_stress
                                                                         : StressState::three_dimensional;
  std::optional<SlowestSwing> slowest;
  for (const BodyInput& body : problem.bodies) {
    if (!body.shape) continue;
    const auto material =
        std::find_if(problem.materials.begin(), problem.materials.end(), [&](const MaterialInput& m) { return m.name == body.material; });
    if (material == problem.materials.end()) continue;
    const Bounds3 box = body.shape->bounds();
    double longest = 0, shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < problem.dimension(); ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const double grid_low = problem.grid.origin[axis], grid_high = grid_low + problem.grid.size[axis];  // shapes may be infinite
      const double side = std::fmin(box.high[k], grid_high) - std::fmax(box.low[k], grid_low);
      longest = std::fmax(longest, side);
      shortest = std::fmin(shortest, side);
    }
    if (!(longest > 0)) continue;
    const double c = material->law->wave_speed(state);
    const SlowestSwing swing{body.name, std::numbers::pi * c / (2 * longest), 1.015 * c * shortest / (longest * longest)};
    if (!slowest || swing.frequency() < slowest->frequency()) slowest = swing;
  }
  return slowest;
}

}  // namespace crampon
