#pragma once
/// Time series of frames as ParaView collections (.pvd).

#include <filesystem>
#include <string>
#include <vector>

namespace crampon {

struct PvdEntry {
  double time = 0;   ///< s
  std::string file;  ///< relative to the .pvd
};

/// A .pvd that grows: rewritten as a whole after each frame, so that a run cut short leaves a readable series.
class PvdSeries {
 public:
  /// Nothing is written before the first append.
  explicit PvdSeries(std::filesystem::path path) : path_(std::move(path)) {}

  /// file: relative to the .pvd. Throws std::runtime_error (path and reason); the list on disk is then the old one.
  void append(double time, const std::string& file);
  const std::vector<PvdEntry>& entries() const { return entries_; }

 private:
  std::filesystem::path path_;
  std::vector<PvdEntry> entries_;
};

/// Frames of a series, in the order written. Throws std::runtime_error "path: reason".
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

}  // namespace crampon
