#pragma once
/// run.json: who made these results, how big the run was and what it cost.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace crampon {

struct RunRecord {
  std::string status;   ///< "finished", "stopped: ..." or "running"
  std::string version;  ///< of Crampon
  std::string compiler;
  std::string instruction_set;  ///< of the kernels
  std::string started;          ///< UTC, ISO 8601
  int threads = 0;
  std::string input;  ///< file name as given
  std::string title;
  std::int64_t particles = 0;
  std::int64_t steps = 0;
  double end_time = 0;   ///< s, reached
  double time_step = 0;  ///< s, of the first step
  double wall_seconds = 0, cpu_seconds = 0;
  struct Phase {
    std::string name;
    double seconds = 0;  ///< wall
  };
  std::vector<Phase> phases;  ///< in the order of the time step
  double particle_steps_per_second = 0;
  double peak_memory_bytes = 0;
  std::uint64_t state_hash = 0;  ///< of the final state; stored as 16 hexadecimal digits
  std::vector<std::string> notes;
};

/// A record with version, compiler, instruction set and the present time filled in.
RunRecord describe_program();

/// CPU seconds this process has used, all threads, user and system.
double used_cpu_seconds();

/// Largest resident memory of this process so far, bytes.
double peak_memory_bytes();

/// Throws std::runtime_error "path: reason".
void write_run_record(const std::filesystem::path& path, const RunRecord& record);
/// Throws std::runtime_error "path: reason" when the file is missing, damaged or lacks an entry.
RunRecord read_run_record(const std::filesystem::path& path);
/// Is this a record that Crampon wrote, whole or not of this version?
bool is_run_record(const std::filesystem::path& path);

}  // namespace crampon
