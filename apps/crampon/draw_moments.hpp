#pragma once
/// Frames of a results folder as `crampon draw` shows them.

#include <optional>
#include <string>
#include <vector>

#include "crampon/input/problem.hpp"
#include "crampon/output/results_folder.hpp"
#include "crampon/picture/draw.hpp"

namespace crampon::app {

/// A frame with its cracks, rigid bodies and walls, in memory.
struct Moment {
  PointFrame particles;
  std::optional<CrackFrame> cracks;
  std::vector<RigidShape> rigid;
  const CrackFrame* start = nullptr;  ///< cracks at the start, of the Moments that read this; null: there are none
  Snapshot snapshot() const { return {&particles, cracks ? &*cracks : nullptr, rigid, start}; }
  /// Per particle: is it one of a rigid body?
  std::vector<bool> of_rigid_bodies() const;
};

class Moments {
 public:
  explicit Moments(const ResultsFolder& folder);

  const std::vector<PvdEntry>& frames() const { return frames_; }
  /// The input of the run; shapes of rigid bodies and walls stand there, and names of materials. None where this program cannot read it,
  /// which a note has told then.
  const std::optional<Problem>& problem() const { return problem_; }
  Moment read(std::size_t frame) const;

 private:
  const ResultsFolder& folder_;
  std::vector<PvdEntry> frames_, cracks_;
  std::optional<CrackFrame> start_;
  std::optional<Problem> problem_;
};

/// "note: ..." on stderr, as stdout lists the pictures.
void tell(const std::string& note);

}  // namespace crampon::app
