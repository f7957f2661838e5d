#pragma once
/// The one folder a run writes to.

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "crampon/output/frame.hpp"
#include "crampon/output/pvd.hpp"
#include "crampon/output/vtp.hpp"

namespace crampon {

/// The folder already holds results and overwriting was not asked for.
class ResultsExist : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What to do with older results.
enum class Overwrite { refuse, replace };

/// Older results in a folder, set aside in a sub-folder of it while a new run starts there. Unless remove() is called they come back at the
/// end of its life, in place of what the new run has written until then.
class OlderResults {
 public:
  /// Files that a run writes and pictures drawn of it, and nothing else; does nothing where there are none. Throws std::runtime_error
  /// "path: reason"; the folder is then as before.
  explicit OlderResults(const std::filesystem::path& folder);
  ~OlderResults();
  OlderResults(const OlderResults&) = delete;
  OlderResults& operator=(const OlderResults&) = delete;

  /// The new run has started. Throws std::runtime_error "path: reason".
  void remove();

  const std::filesystem::path& folder() const { return folder_; }

 private:
  void put_back() noexcept;
  void delete_removed();

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;  // set aside, relative to the folder
};

/// Names and time series of a results folder:
///   particles.pvd  particles/particles_000000.vtp ...     history.csv, events.csv (when something failed)
///   cracks.pvd     cracks/cracks_000000.vtp ...           run.json
///   grid.pvd       grid/grid_000000.vtp ...               input.resolved.toml, input.original.toml
class ResultsFolder {
 public:
  /// For a run. Creates the folder and those above it. When a run wrote there before: refuse throws ResultsExist; replace removes the
  /// files a run writes and pictures drawn of it, and nothing else; without a run.json of Crampon it throws ResultsExist too. Throws
  /// std::runtime_error "path: reason" when that cannot be done; older results are then still there.
  static ResultsFolder create(const std::filesystem::path& path, Overwrite overwrite = Overwrite::refuse);
  /// The same in a folder whose older results are set aside already. Throws std::runtime_error "path: reason".
  static ResultsFolder start(const OlderResults& older);
  /// The ResultsExist that create would throw, without touching anything: to be asked before a long preparation.
  static void check(const std::filesystem::path& path, Overwrite overwrite);
  /// For reading. Throws std::runtime_error when the folder is missing or holds no results.
  static ResultsFolder open(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path history() const { return path_ / "history.csv"; }
  std::filesystem::path events() const { return path_ / "events.csv"; }
  std::filesystem::path run_record() const { return path_ / "run.json"; }
  std::filesystem::path resolved_input() const { return path_ / "input.resolved.toml"; }
  std::filesystem::path original_input() const { return path_ / "input.original.toml"; }
  std::filesystem::path particles_series() const { return path_ / "particles.pvd"; }
  std::filesystem::path cracks_series() const { return path_ / "cracks.pvd"; }
  std::filesystem::path grid_series() const { return path_ / "grid.pvd"; }

  /// Writes one frame and adds it to its series. Throws std::runtime_error "path: reason"; earlier frames and lists stay whole.
  void write_particles(PointFrame frame, Precision precision = Precision::single);
  void write_cracks(CrackFrame frame, Precision precision = Precision::single);
  void write_grid(PointFrame frame, Precision precision = Precision::single);
  void write_resolved_input(std::string_view text);

  /// Frames on disk; empty when the series was not written.
  std::vector<PvdEntry> particle_frames() const;
  std::vector<PvdEntry> crack_frames() const;
  std::vector<PvdEntry> grid_frames() const;
  PointFrame read_particles(const PvdEntry& entry) const { return read_vtp(path_ / entry.file); }
  CrackFrame read_cracks(const PvdEntry& entry) const { return read_crack_vtp(path_ / entry.file); }

 private:
  explicit ResultsFolder(std::filesystem::path path);
  template <class Frame>
  void write_frame(PvdSeries& series, const char* name, Frame frame, Precision precision);

  std::filesystem::path path_;
  PvdSeries particles_, cracks_, grid_;
};

}  // namespace crampon
