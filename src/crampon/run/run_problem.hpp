#pragma once
/// Runs a simulation to its end and writes everything a run writes into one results folder.

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "crampon/output/results_folder.hpp"
#include "crampon/output/run_record.hpp"
#include "crampon/run/simulation.hpp"

namespace crampon {

/// How far a run has come, told after every step.
struct Progress {
  std::int64_t step = 0;
  std::int64_t particles = 0;
  double time = 0, end_time = 0;  ///< s
  double wall_seconds = 0;        ///< since the first step began
};

struct RunOptions {
  std::filesystem::path folder;  ///< of the results
  Overwrite overwrite = Overwrite::refuse;
  int threads = 1;    ///< for the record: the simulation was created with it
  std::string input;  ///< name of the input file, for the record
  std::function<void(const Progress&)> progress;
  std::optional<std::int64_t> most_steps;        ///< end earlier than the input says, to try it
  const std::atomic<bool>* interrupt = nullptr;  ///< set from outside (Ctrl-C): the run ends in order after the present step
};

struct RunOutcome {
  enum class End {
    finished,
    shortened,    ///< by RunOptions::most_steps
    interrupted,  ///< last state written as a frame
    stopped       ///< RunError; the state it left is the last frame, for inspection
  } end = End::finished;
  std::string message;  ///< of the RunError
  RunRecord record;     ///< as in run.json
  std::filesystem::path folder;
};

/// Threads when the user names no number: OMP_NUM_THREADS, else one per core that this process may use.
int default_threads();
/// Cores that this process may use.
int core_count();

/// Frames as problem.output asks, each at its time exactly, and always a first and a last one; history rows; input.original.toml and
/// input.resolved.toml; run.json, which says "running" until the end.
/// Throws InputError as check_against_simulation and ResultsExist, both before anything is written; std::runtime_error "path: reason"
/// when a file cannot be written (run.json then tells, when it still can be).
RunOutcome run_problem(const Problem& problem, Simulation& simulation, const RunOptions& options);

/// The InputError of run_problem without running: what only the simulation tells. Do all columns and quantities that the input names
/// exist, and is the time between frames worth cutting time steps for?
void check_against_simulation(const Problem& problem, const Simulation& simulation);

}  // namespace crampon
