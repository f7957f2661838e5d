#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/input/read_problem.hpp"
#include "crampon/output/crack_tips.hpp"
#include "crampon/run/estimate.hpp"
#include "crampon/run/run_problem.hpp"
#include "terminal.hpp"

namespace crampon::app {

namespace {

/// How much damping is wanted: where there is some, or where rest is waited for.
std::string damping_advice(const Problem& problem) {
  const auto acts = [](const ValueFunction& damping) { return damping.depends_on_time() || damping(0, {}) != 0; };
  const auto swing = estimate_slowest_swing(problem);
  if (!swing || !(problem.time.stop_at_rest || acts(problem.method.damping) || acts(problem.method.particle_damping))) return "";
  const std::string bending =
      swing->bending < swing->along ? fmt::format(", {:.3g} 1/s for bending", critical_damping(swing->bending)) : "";
  return fmt::format(
      "critical at {:.3g} 1/s for waves along \"{}\"{}, if it is held at one end (estimated from its size and wave speed); less rings, "
      "more "
      "creeps",
      critical_damping(swing->along), swing->body, bending);
}

/// Which ends of cracks are tips.
std::string tips_text(const CrackFrame& cracks) {
  std::string text;
  for (const FrameTip& tip : tips_of(cracks))
    text += fmt::format("{}{} of \"{}\"", text.empty() ? "" : ", ", tip.end(), cracks.names[tip.crack]);
  return text.empty() ? "none: no end of a crack lies in a body" : text;
}

}  // namespace

int validate_command(const ValidateArguments& arguments) {
  const Problem problem = read_problem(arguments.input, arguments.settings);
  const int threads = usable_threads(arguments.threads);
  const auto simulation = Simulation::create(problem, threads);
  check_against_simulation(problem, *simulation);
  const SimulationSize size = simulation->size();
  const double end_time = simulation->end_time();

  const auto line = [](const char* what, const std::string& value) { fmt::print("  {:<14} {}\n", what, value); };
  fmt::print("{}\n", arguments.input);
  if (!problem.title.empty()) line("title", problem.title);
  line("particles", count_text(static_cast<double>(size.particles)));
  line("cells", fmt::format("{} in the grid, {} in blocks that hold particles", count_text(static_cast<double>(size.cells)),
                            count_text(static_cast<double>(size.active_cells))));
  for (const LoadSummary& load : simulation->loads()) line("load", load_text(load));
  if (size.cracks > 0) line("cracks", fmt::format("{} with {} segments", size.cracks, size.crack_segments));
  if (problem.fracture) line("tips", tips_text(simulation->cracks()));
  line("steps", count_text(static_cast<double>(size.steps)));
  line("time step", fmt::format("{:.6g} s", size.time_step));
  line("end time", fmt::format("{:.6g} s", end_time));
  if (const std::string advice = damping_advice(problem); !advice.empty()) line("damping", advice);
  line("memory", bytes_text(size.memory_bytes));
  std::vector<std::string> notes = simulation->notes_at_start();
  if (std::string note = threads_note(arguments.threads); !note.empty()) notes.push_back(std::move(note));
  print_notes(notes);
  std::fflush(stdout);

  const RunEstimate estimate = estimate_run(*simulation);
  if (!estimate.stopped.empty()) {
    fmt::print(stderr, "{} {}\n", styled(stderr, Style::red, "crampon: the run would stop:"), estimate.stopped);
    return exit_run_stopped;
  }
  line("expected time", fmt::format("{} with {} thread{}, output apart ({} steps measured, {} each)", duration_text(estimate.seconds),
                                    threads, threads == 1 ? "" : "s", estimate.steps_measured, duration_text(estimate.seconds_per_step)));
  const std::string count = notes.empty() ? "" : fmt::format(", with {} note{}", notes.size(), notes.size() == 1 ? "" : "s");
  fmt::print("{}: {}{}\n", arguments.input, styled(stdout, Style::green, "valid"), count);
  return exit_ok;
}

}  // namespace crampon::app
