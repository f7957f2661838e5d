#include "crampon/step/tip_frame.hpp"

namespace crampon {

namespace {

/// The direction of a tip is that of the chord from where its path is `chord` away from it: a kink of a fraction of a cell says little yet.
TipFrame frame_of(const std::vector<Vec<2>>& points, const Crack<2>& crack, const CrackTip& tip, double chord) {
  const TipVertices vertices(crack, tip);
  const Vec<2>& x = crack.original[vertices[0]];
  for (std::size_t k = 1; k < vertices.size(); ++k) {
    const double before = norm(crack.original[vertices[k - 1]] - x), here = norm(crack.original[vertices[k]] - x);
    if (here < chord && k + 1 < vertices.size()) continue;
    const double s = here > chord && here > before ? (chord - before) / (here - before) : 1;
    return {points[vertices[0]], points[vertices[k - 1]] * (1 - s) + points[vertices[k]] * s};
  }
  return {points[vertices[0]], points[vertices[1]]};
}

}  // namespace

TipFrame original_frame(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip) {
  return frame_of(crack.original, crack, tip, chord_in_cells * model.grid.largest_cell());
}
TipFrame present_frame(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip) {
  return frame_of(crack.plane, crack, tip, chord_in_cells * model.grid.largest_cell());
}

Vec<2> opening_behind(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip) {
  const double distance = opening_in_cells * model.grid.largest_cell();
  const TipVertices vertices(crack, tip);
  const TipFrame frame = present_frame(model, crack, tip);
  const auto opening = [&](std::size_t k) { return frame.turned(crack.upper[vertices[k]] - crack.lower[vertices[k]]) * vertices.sign(); };
  double behind = 0;
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
    const double length = norm(crack.original[vertices[k + 1]] - crack.original[vertices[k]]);
    if (behind + length >= distance) {
      const double s = (distance - behind) / length;
      return opening(k) * (1 - s) + opening(k + 1) * s;
    }
    behind += length;
  }
  return opening(vertices.size() - 1);
}

}  // namespace crampon
