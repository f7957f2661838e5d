#include <algorithm>
#include <csignal>
#include <filesystem>

#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/input/read_problem.hpp"
#include "crampon/run/check.hpp"
#include "terminal.hpp"

namespace crampon::app {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

/// The first Ctrl-C asks the run to end in order, the second one ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard() {
    for (const int signal : {SIGINT, SIGTERM}) {
      std::signal(signal, [](int received) {
        interrupted = true;
        std::signal(received, SIG_DFL);
      });
    }
  }
  ~InterruptGuard() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

void print_start(const Problem& problem, const Simulation& simulation, int threads) {
  const SimulationSize size = simulation.size();
  fmt::print("{}\n", styled(stdout, Style::bold, problem.title.empty() ? "untitled" : problem.title));
  fmt::print("{} particles, {} cells", count_text(static_cast<double>(size.particles)), count_text(static_cast<double>(size.cells)));
  if (size.cracks > 0) fmt::print(", {} cracks with {} segments", size.cracks, size.crack_segments);
  fmt::print("; {} steps of about {}; {} thread{}\n", count_text(static_cast<double>(size.steps)), duration_text(size.time_step), threads,
             threads == 1 ? "" : "s");
  print_notes(simulation.notes_at_start());
  for (const LoadSummary& load : simulation.loads()) fmt::print("load {}\n", load_text(load));
  std::fflush(stdout);
}

void print_end(const Simulation& simulation, const RunOutcome& outcome, const std::vector<CheckRow>& rows) {
  const RunRecord& record = outcome.record;
  fmt::print("{} after {} steps at t = {:.6g} s, in {} ({:.2f} million particle-steps per second)\n",
             record.status.substr(0, record.status.find(':')), count_text(static_cast<double>(record.steps)), record.end_time,
             duration_text(record.wall_seconds), record.particle_steps_per_second * 1e-6);
  print_notes(simulation.notes());
  if (!rows.empty()) fmt::print("\n{}", check_table(rows));
  const std::string folder = shell_quoted(outcome.folder.string());
  fmt::print("\nResults are in {}\n", styled(stdout, Style::bold, folder));
  fmt::print("  pictures:  {} draw {}\n", command_name(), folder);
  fmt::print("  plots:     {} draw {} --history kinetic_energy strain_energy\n", command_name(), folder);
  fmt::print("  ParaView:  paraview {}\n", shell_quoted((outcome.folder / "particles.pvd").string()));
}

}  // namespace

int run_command(const RunArguments& arguments) {
  const Problem problem = read_problem(arguments.input, arguments.settings);
  RunOptions options;
  options.folder = arguments.output.empty() ? std::filesystem::path(arguments.input).stem().string() + ".results" : arguments.output;
  options.overwrite = arguments.force ? Overwrite::replace : Overwrite::refuse;
  options.threads = usable_threads(arguments.threads);
  options.input = arguments.input;
  options.most_steps = arguments.steps;
  options.interrupt = &interrupted;
  ResultsFolder::check(options.folder, options.overwrite);  // before a large problem is built

  const auto simulation = Simulation::create(problem, options.threads);
  ProgressLine progress;
  if (!arguments.quiet) {
    print_start(problem, *simulation, options.threads);
    if (const std::string note = threads_note(arguments.threads); !note.empty()) print_notes({note});
    options.progress = [&progress](const Progress& p) { progress.show(p); };
  }
  RunOutcome outcome;
  {
    const InterruptGuard guard;
    try {
      outcome = run_problem(problem, *simulation, options);
    } catch (...) {
      progress.finish();
      throw;
    }
  }
  progress.finish();

  std::vector<CheckRow> rows;
  if (outcome.end == RunOutcome::End::finished && !arguments.no_check) rows = check_results(ResultsFolder::open(outcome.folder), problem);
  if (!arguments.quiet) print_end(*simulation, outcome, rows);
  switch (outcome.end) {
    case RunOutcome::End::stopped: {
      const std::string where = (outcome.folder / "particles.pvd").string();
      fmt::print(stderr, "{} {}\nThe state it left is the last frame of {}; the frames before it are good.\n",
                 styled(stderr, Style::red, "crampon: the run stopped:"), outcome.message, where);
      return exit_run_stopped;
    }
    case RunOutcome::End::interrupted:
      fmt::print(stderr, "crampon: interrupted at t = {:.6g} s; the state there is the last frame\n", outcome.record.end_time);
      return exit_interrupted;
    default:
      break;
  }
  const auto missed = std::count_if(rows.begin(), rows.end(), [](const CheckRow& row) { return row.verdict != Verdict::met; });
  if (missed == 0) return exit_ok;
  fmt::print(stderr, "{} {} of {} expected numbers missed; `{} check {}` shows them\n", styled(stderr, Style::red, "crampon:"), missed,
             rows.size(), command_name(), shell_quoted(outcome.folder.string()));
  return exit_check_missed;
}

}  // namespace crampon::app
