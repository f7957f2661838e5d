#pragma once
/// The tips that a frame of cracks tells of, and which part of a crack has grown.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "crampon/output/frame.hpp"
#include "crampon/state/fracture.hpp"

namespace crampon {

struct FrameTip {
  std::size_t crack = 0;   ///< its number in the frame
  std::size_t vertex = 0;  ///< its number among all vertices of the frame
  bool at_end = true;      ///< of the path, not at its start
  TipStatus status = TipStatus::waits;

  /// Does it still lie in a body?
  bool is_in_body() const { return status != TipStatus::joined && status != TipStatus::left; }
  const char* end() const { return at_end ? "end" : "start"; }
};

/// In the order of cracks, the start of each before its end; none where the run had no [fracture].
std::vector<FrameTip> tips_of(const CrackFrame& frame);

/// A quantity at a vertex; nan where the frame does not have it.
double value_at(const CrackFrame& frame, const std::string& quantity, std::size_t vertex);

/// The first and the last of the vertices, among all of the frame, that a crack had in an earlier frame. None: it was not there. Where that cannot be told
/// all vertices count.
std::optional<std::pair<std::size_t, std::size_t>> vertices_before(const CrackFrame& frame, std::size_t crack, const CrackFrame& earlier);

}  // namespace crampon
