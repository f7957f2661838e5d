#include "crampon/run/run_problem.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <optional>

#include <fmt/format.h>
#include <omp.h>

#include "crampon/core/closest_name.hpp"
#include "crampon/core/units.hpp"
#include "crampon/output/file.hpp"
#include "crampon/output/history.hpp"
#include "crampon/output/quantity.hpp"
#include "crampon/run/schedule.hpp"

namespace crampon {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) { return std::chrono::duration<double>(to - from).count(); }

/// The files of one run.
class Recorder {
 public:
  Recorder(const Problem& problem, const Simulation& simulation, const RunOptions& options)
      : problem_(problem),
        simulation_(simulation),
        older_(checked(options)),
        folder_(ResultsFolder::start(older_)),
        history_(folder_.history(), simulation.history_columns()),
        frames_(problem.output),
        rows_(problem.output, problem.time, simulation.end_time()) {
    if (!problem.source.empty()) write_file(folder_.path() / "input.original.toml", problem.source);
    const std::string shortened = options.most_steps ? fmt::format("# ended after {} steps at most (--steps)\n", *options.most_steps) : "";
    folder_.write_resolved_input(shortened + problem.resolved);
    frames_.take(simulation.time(), 0, 0);  // a listed time of 0 is the first frame, which is always written
  }

  double next_frame_time() const { return frames_.next_time(); }
  /// The next state that is written.
  NextLook next_look() const {
    const std::int64_t steps = simulation_.steps_done();
    return {std::min(frames_.next_step(steps), rows_.next_step(steps)), std::min(frames_.next_time(), rows_.next_time())};
  }
  const ResultsFolder& folder() const { return folder_; }
  double seconds() const { return seconds_; }

  /// Writes what is due after a step. slack: see FrameSchedule::take.
  void record_step(double slack) {
    const Clock::time_point start = Clock::now();
    if (frames_.take(simulation_.time(), simulation_.steps_done(), slack)) write_frame();
    if (rows_.take(simulation_.time(), simulation_.steps_done(), slack)) write_row();
    write_events();
    seconds_ += seconds_between(start, Clock::now());
  }
  /// Frame and row of the present state, unless they are there already.
  void record_state() {
    const Clock::time_point start = Clock::now();
    if (last_frame_ != simulation_.steps_done()) write_frame();
    if (last_row_ != simulation_.steps_done()) write_row();
    seconds_ += seconds_between(start, Clock::now());
  }
  /// Until the first frame is on disk. Only then do older results go: whatever keeps a run from starting must not cost them.
  void finish_start() {
    finish();
    older_.remove();
  }
  /// What a failed step left, as a frame only: its sums mean nothing.
  void record_wreck() { write_frame(); }
  /// Until all frames are on disk. Throws what kept one from it.
  void finish() {
    const Clock::time_point start = Clock::now();
    if (writing_.valid()) writing_.get();
    seconds_ += seconds_between(start, Clock::now());
  }

 private:
  static const std::filesystem::path& checked(const RunOptions& options) {
    ResultsFolder::check(options.folder, options.overwrite);
    return options.folder;
  }

  struct Frames {
    std::optional<PointFrame> particles, grid;
    std::optional<CrackFrame> cracks;
  };
  /// Takes a copy of what is to be written, which another thread compresses and writes: one frame at a time, so that memory is bounded.
  /// Throws what went wrong with the frame before.
  void write_frame() {
    if (writing_.valid()) writing_.get();
    const Precision precision = problem_.output.full_precision ? Precision::full : Precision::single;
    Frames frames;
    frames.particles = simulation_.particles(problem_.output.quantities, precision);
    CrackFrame cracks = simulation_.cracks();
    if (!cracks.names.empty()) frames.cracks = std::move(cracks);  // none has started yet
    // Before the first step nodes hold nothing.
    if (problem_.output.grid && simulation_.steps_done() > 0) frames.grid = simulation_.nodes();
    last_frame_ = simulation_.steps_done();
    writing_ = std::async(std::launch::async, [this, precision, frames = std::move(frames)]() mutable {
      folder_.write_particles(std::move(*frames.particles), precision);
      if (frames.cracks) folder_.write_cracks(std::move(*frames.cracks), precision);
      if (frames.grid) folder_.write_grid(std::move(*frames.grid), precision);
    });
  }
  void write_events() {
    if (events_written_ == simulation_.event_count()) return;
    if (!events_) events_.emplace(folder_.events(), simulation_.event_columns());
    for (; events_written_ < simulation_.event_count(); ++events_written_) events_->write_row(simulation_.event_row(events_written_));
  }
  void write_row() {
    history_.write_row(simulation_.history_row());
    last_row_ = simulation_.steps_done();
  }

  const Problem& problem_;
  const Simulation& simulation_;
  OlderResults older_;  // comes back after everything below is gone
  ResultsFolder folder_;
  HistoryWriter history_;
  std::optional<HistoryWriter> events_;
  std::size_t events_written_ = 0;
  FrameSchedule frames_;
  HistorySchedule rows_;
  std::int64_t last_frame_ = -1, last_row_ = -1;  // steps done when last written
  double seconds_ = 0;                            // that the run waited
  std::future<void> writing_;                     // the frame on its way to disk; last, so that it is waited for before anything else goes
};

RunRecord describe_run(const Problem& problem, const Simulation& simulation, const RunOptions& options) {
  RunRecord record = describe_program();
  record.threads = options.threads;
  record.input = options.input;
  record.title = problem.title;
  const SimulationSize size = simulation.size();
  record.particles = size.particles;
  record.time_step = size.time_step;
  return record;
}

/// Brings the record up to the present state.
void update(RunRecord& record, const Simulation& simulation, const Recorder& recorder, double stepping, double cpu_at_start) {
  record.steps = simulation.steps_done();
  record.end_time = simulation.time();
  record.phases.clear();
  for (const PhaseTime& phase : simulation.phases()) record.phases.push_back({phase.name, phase.seconds});
  record.phases.push_back({"write output", recorder.seconds()});
  record.wall_seconds = stepping + recorder.seconds();
  record.cpu_seconds = used_cpu_seconds() - cpu_at_start;
  // Writing left out: the figure compares engines and machines, not disks.
  record.particle_steps_per_second =
      stepping > 0 ? static_cast<double>(record.particles) * static_cast<double>(record.steps) / stepping : 0;
  record.peak_memory_bytes = peak_memory_bytes();
  record.state_hash = simulation.state_hash();
  record.notes = simulation.notes_at_start();
  for (std::string& note : simulation.notes()) record.notes.push_back(std::move(note));
}

}  // namespace

int default_threads() { return omp_get_max_threads(); }
int core_count() { return omp_get_num_procs(); }

namespace {

/// What is expected must have the dimension of what is measured.
void check_units(const Problem& problem, const ExpectInput& expect, const std::string& measured, std::vector<Diagnostic>& found) {
  const std::string si = measured.empty() ? "1" : measured;
  const auto check = [&](const char* key, auto convert) {
    try {
      convert();
    } catch (const UnitError& error) {
      found.push_back({expect.at(key), error.what, error.why, error.remedy});
    }
  };
  for (const char* key : {"value", "tolerance"}) {
    const auto text = problem.written.find(expect.location.where + "." + key);
    if (text != problem.written.end()) check(key, [&] { parse_quantity(text->second, si); });
  }
  if (!expect.unit.empty()) check("unit", [&] { unit_factor(expect.unit, si); });
}

}  // namespace

void check_against_simulation(const Problem& problem, const Simulation& simulation) {
  std::vector<Diagnostic> found;
  std::vector<std::string> columns;
  for (const HistoryColumn& column : simulation.history_columns()) columns.push_back(column.name);
  const std::vector<std::string> quantities = simulation.particle_quantities();
  const auto known = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const ExpectInput& expect : problem.expects) {
    if (!expect.column) continue;
    const auto column = std::find(columns.begin(), columns.end(), *expect.column);
    if (column == columns.end()) {
      found.push_back({expect.at("column"), fmt::format("the history has no column \"{}\"", *expect.column), "",
                       suggest_from(*expect.column, columns)});
    } else {
      check_units(problem, expect, simulation.history_columns()[static_cast<std::size_t>(column - columns.begin())].unit, found);
    }
  }
  for (const std::string& name : problem.output.quantities)
    if (!known(quantities, name))
      found.push_back(
          {problem.output.at("quantities"), fmt::format("particles have no quantity \"{}\"", name), "", suggest_from(name, quantities)});
  const bool of_particles =
      std::any_of(problem.expects.begin(), problem.expects.end(), [](const ExpectInput& e) { return e.quantity.has_value(); });
  if (found.empty() && of_particles) {
    const PointFrame frame = simulation.particles(problem.output.quantities, Precision::single);
    for (const ExpectInput& expect : problem.expects) try {
        if (expect.quantity) check_units(problem, expect, evaluate_quantity(frame, *expect.quantity).unit, found);
      } catch (const std::invalid_argument& error) {
        found.push_back({expect.at("quantity"), error.what(), "only what [output] writes can be checked",
                         "choose another quantity or add it to output.quantities"});
      }
  }
  if (problem.output.every && *problem.output.every < 0.01 * simulation.size().time_step)
    found.push_back({problem.output.at("every"),
                     fmt::format("frames every {:g} s with time steps of {:g} s", *problem.output.every, simulation.size().time_step),
                     "each time step would be cut into more than a hundred", "write a frame every step: every_steps = 1"});
  if (!found.empty()) throw InputError(std::move(found));
}

RunOutcome run_problem(const Problem& problem, Simulation& simulation, const RunOptions& options) {
  check_against_simulation(problem, simulation);
  Recorder recorder(problem, simulation, options);
  RunOutcome outcome;
  outcome.record = describe_run(problem, simulation, options);
  outcome.folder = recorder.folder().path();
  RunRecord& record = outcome.record;
  record.status = "running";
  const double cpu_at_start = used_cpu_seconds();
  double stepping = 0;  // wall s in the engine

  try {
    write_run_record(recorder.folder().run_record(), record);
    recorder.record_state();
    recorder.finish_start();
    record.status = "finished";
    bool was_announced = true;  // to the simulation: the present state will be looked at
    while (!simulation.finished()) {
      if (options.most_steps && simulation.steps_done() >= *options.most_steps) {
        outcome.end = RunOutcome::End::shortened;
        record.status = "shortened";
        break;
      }
      const bool interrupted = options.interrupt != nullptr && options.interrupt->load();
      if (interrupted && was_announced) {
        outcome.end = RunOutcome::End::interrupted;
        record.status = "interrupted";
        break;
      }
      NextLook look = interrupted ? NextLook{} : recorder.next_look();
      if (options.most_steps) look.step = std::min(look.step, *options.most_steps);
      const double before = simulation.time();
      const Clock::time_point start = Clock::now();
      try {
        simulation.step(recorder.next_frame_time(), look);
      } catch (const RunError& error) {
        outcome.end = RunOutcome::End::stopped;
        outcome.message = error.what();
        record.status = "stopped: " + outcome.message;
        break;
      }
      stepping += seconds_between(start, Clock::now());
      was_announced = simulation.steps_done() >= look.step || simulation.time() >= look.time;
      // A sum of a million time steps is off by less than this part of one.
      recorder.record_step(1e-6 * (simulation.time() - before));
      if (options.progress)
        options.progress(
            {simulation.steps_done(), record.particles, simulation.time(), simulation.end_time(), stepping + recorder.seconds()});
    }
    if (outcome.end == RunOutcome::End::stopped)
      recorder.record_wreck();
    else
      recorder.record_state();
    recorder.finish();
    update(record, simulation, recorder, stepping, cpu_at_start);
    write_run_record(recorder.folder().run_record(), record);
  } catch (const std::exception& error) {
    // Output failed, most likely a full disk: the record of a few hundred bytes may still fit, and else the first error counts.
    try {
      record.status = fmt::format("stopped: {}", error.what());
      update(record, simulation, recorder, stepping, cpu_at_start);
      write_run_record(recorder.folder().run_record(), record);
    } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): told by the error that follows
    }
    throw;
  }
  return outcome;
}

}  // namespace crampon
