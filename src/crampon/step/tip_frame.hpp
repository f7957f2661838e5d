#pragma once
/// Where the tips of cracks lie and where they look, in the undeformed body and at present.

#include "crampon/crack/tip_domain.hpp"
#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// The vertices of a crack from a tip backwards.
class TipVertices {
 public:
  TipVertices(const Crack<2>& crack, const CrackTip& tip) : count_(crack.plane.size()), from_start_(tip.end == 0) {}
  std::size_t size() const { return count_; }
  std::size_t operator[](std::size_t k) const { return from_start_ ? k : count_ - 1 - k; }
  /// Of the opening, upper less lower, that of the side to the left of a tip less that to the right.
  double sign() const { return from_start_ ? -1 : 1; }

 private:
  std::size_t count_;
  bool from_start_;
};

/// Cells between the ends of the chord that gives a tip its direction.
inline constexpr double chord_in_cells = 2;
/// How far behind a tip its opening is taken, cells.
inline constexpr double opening_in_cells = 2;

TipFrame original_frame(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip);
TipFrame present_frame(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip);

/// Opening behind a tip, in its present frame: {sliding, opening} of the left side, m.
Vec<2> opening_behind(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip);

}  // namespace crampon
