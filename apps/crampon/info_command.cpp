#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/output/crack_tips.hpp"
#include "crampon/output/history.hpp"
#include "crampon/output/quantity.hpp"
#include "crampon/output/results_folder.hpp"
#include "crampon/output/results_hash.hpp"
#include "crampon/output/run_record.hpp"
#include "terminal.hpp"

namespace crampon::app {
namespace {

void line(const char* what, const std::string& value) { fmt::print("  {:<14} {}\n", what, value); }

void print_frames(const char* name, const std::vector<PvdEntry>& frames) {
  if (!frames.empty())
    line(name, fmt::format("{} frames, t = {:.6g} s to {:.6g} s", frames.size(), frames.front().time, frames.back().time));
}

void print_record(const RunRecord& record) {
  if (!record.title.empty()) line("title", record.title);
  line("input", record.input);
  const bool cut_short = record.status == "running";
  line("status", cut_short ? "running, or ended without a word (killed); what follows is from its frames" : record.status);
  line("started", record.started);
  line("program", fmt::format("crampon {}, {}, {}", record.version, record.compiler, record.instruction_set));
  line("particles", count_text(static_cast<double>(record.particles)));
  if (cut_short) return;
  line("steps", fmt::format("{}, the first of {:.6g} s", count_text(static_cast<double>(record.steps)), record.time_step));
  line("end time", fmt::format("{:.6g} s", record.end_time));
  line("wall time",
       fmt::format("{} with {} threads (CPU {})", duration_text(record.wall_seconds), record.threads, duration_text(record.cpu_seconds)));
  line("speed", fmt::format("{:.3g} million particle-steps per second", record.particle_steps_per_second * 1e-6));
  line("peak memory", bytes_text(record.peak_memory_bytes));
  line("state hash", fmt::format("{:016x}", record.state_hash));
  for (const std::string& note : record.notes) line("note", note);
  double total = 0;
  for (const RunRecord::Phase& phase : record.phases) total += phase.seconds;
  if (total <= 0) return;
  // Wall time, by particles and steps: what a phase costs whatever the size of the run.
  const double particle_steps = static_cast<double>(record.particles) * static_cast<double>(record.steps);
  fmt::print("\n  time by phase {:>34} ns per particle-step\n", "");
  for (const RunRecord::Phase& phase : record.phases) {
    fmt::print("    {:<28} {:>10}  {:4.1f} %  {:>8}\n", phase.name, duration_text(phase.seconds), 100 * phase.seconds / total,
               particle_steps > 0 ? fmt::format("{:.1f}", phase.seconds / particle_steps * 1e9) : "");
  }
}

/// The tips of cracks in a frame, SI.
void print_tips(const CrackFrame& frame) {
  const std::vector<FrameTip> tips = tips_of(frame);
  if (tips.empty()) return;
  std::size_t widest = 5;
  for (const FrameTip& tip : tips) widest = std::max(widest, frame.names[tip.crack].size());
  const auto row = [&](const auto& crack, const auto& end, const auto& x, const auto& y, const auto& grown, const auto& status,
                       const auto& J, const auto& K_I, const auto& K_II) {
    fmt::print("    {:<{}}  {:<5}  {:>11}  {:>11}  {:>10}  {:<8}  {:>10}  {:>16}  {:>17}\n", crack, widest, end, x, y, grown, status, J,
               K_I, K_II);
  };
  fmt::print("\n  tips of cracks at t = {:.6g} s\n", frame.time);
  row("crack", "end", "x [m]", "y [m]", "grown [m]", "status", "J [J/m2]", "K_I [Pa m^(1/2)]", "K_II [Pa m^(1/2)]");
  for (const FrameTip& tip : tips) {
    const auto number = [&](const char* quantity) {
      const double value = value_at(frame, quantity, tip.vertex);
      return std::isnan(value) ? std::string("-") : fmt::format("{:.4g}", value);
    };
    row(frame.names[tip.crack], tip.end(), fmt::format("{:.6g}", frame.plane[3 * tip.vertex]),
        fmt::format("{:.6g}", frame.plane[3 * tip.vertex + 1]), number("grown"),
        tip_status_words[static_cast<std::size_t>(tip.status)].word, number("J"), number("K_I"), number("K_II"));
  }
}

}  // namespace

int info_command(const InfoArguments& arguments) {
  const ResultsFolder folder = ResultsFolder::open(arguments.results);
  if (arguments.hash) {
    fmt::print("{:016x}\n", hash_results(folder));
    return exit_ok;
  }
  const RunRecord record = read_run_record(folder.run_record());
  fmt::print("{}\n", styled(stdout, Style::bold, arguments.results));
  print_record(record);

  fmt::print("\n");
  const std::vector<PvdEntry> frames = folder.particle_frames();
  print_frames("particles.pvd", frames);
  const std::vector<PvdEntry> cracks = folder.crack_frames();
  print_frames("cracks.pvd", cracks);
  print_frames("grid.pvd", folder.grid_frames());
  if (!frames.empty()) line("quantities", fmt::format("{}", fmt::join(quantity_names(folder.read_particles(frames.back())), ", ")));
  const History history = read_history(folder.history());
  std::vector<std::string> columns;
  for (const HistoryColumn& column : history.columns) columns.push_back(fmt::format("{}[{}]", column.name, column.unit));
  line("history.csv", fmt::format("{} rows: {}", history.rows(), fmt::join(columns, ", ")));
  if (!cracks.empty()) print_tips(folder.read_cracks(cracks.back()));
  return exit_ok;
}

}  // namespace crampon::app
