#include "crampon/step/crack_surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {

namespace {

/// Weights along one axis of a point without size: linear, or quadratic B-spline. first: the lowest of `count` nodes.
struct AxisWeights {
  int first = 0, count = 2;
  std::array<double, 3> w{};

  AxisWeights(double g, bool bspline) {
    if (!bspline) {
      first = static_cast<int>(std::floor(g));
      w = {1 - (g - first), g - first, 0};
      return;
    }
    first = static_cast<int>(std::floor(g - 0.5));
    count = 3;
    const double f = g - 0.5 - first;
    w = {0.5 * (1 - f) * (1 - f), 0.75 - (f - 0.5) * (f - 0.5), 0.5 * f * f};
  }
};

bool by_bsplines(const Model<2>& model) {
  return model.shape_functions == ShapeFunctionKind::bspline && model.crack_shape_functions == CrackShapeFunctions::same;
}

}  // namespace

Vec<2> vertex_normal(const Crack<2>& crack, std::size_t v) {
  const std::size_t last = crack.plane.size() - 1;
  Vec<2> n{};
  if (v > 0 || crack.closed) n += segment_normal(crack.plane[v > 0 ? v - 1 : last - 1], crack.plane[v > 0 ? v : last]);
  if (v < last || crack.closed) n += segment_normal(crack.plane[v < last ? v : 0], crack.plane[v < last ? v + 1 : 1]);
  // With the normal of the image, what is across a mirror cancels.
  Vec<2> in_mirrors = n;
  for (const std::size_t end : {0u, 1u}) {
    if (v != (end == 0 ? 0 : last)) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      if (crack.mirrored[end] >> k & 1u) in_mirrors[k] = 0;
    }
  }
  return normalized(in_mirrors == Vec<2>{} ? n : in_mirrors);
}

ForNodes<NodeShare> nodes_around(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x) {
  const Grid<2>& grid = model.grid;
  ForNodes<NodeShare> out;
  const bool bspline = by_bsplines(model);
  const AxisWeights along[2] = {{(x[0] - grid.origin[0]) * grid.inverse_cell[0], bspline},
                                {(x[1] - grid.origin[1]) * grid.inverse_cell[1], bspline}};
  for (int j = 0; j < along[1].count; ++j) {
    for (int i = 0; i < along[0].count; ++i) {
      const double S = along[0].w[i] * along[1].w[j];
      const IndexVector<2> node{along[0].first + i, along[1].first + j};
      if (S == 0 || node[0] < -block_side || node[1] < -block_side) continue;
      const IndexVector<2> block{Grid<2>::block_of(node[0]), Grid<2>::block_of(node[1])};
      if (block[0] >= grid.blocks[0] || block[1] >= grid.blocks[1]) continue;
      const std::uint32_t there = work.blocks.of_number[static_cast<std::size_t>(grid.block_number(block))];
      const int local = (node[1] - Grid<2>::first_node(block[1])) * block_side + node[0] - Grid<2>::first_node(block[0]);
      if (there != no_block) out.push_back({S, grid.node_position(node), there, local});
    }
  }
  return out;
}

Vec<2> CrackSurfaces::beside(const Vec<2>& vertex, const Vec<2>& out) const {
  Vec<2> x = vertex + out * nudge_;
  for (const SymmetryPlane& plane : model_.symmetries) {
    const auto k = static_cast<std::size_t>(plane.axis);
    if (std::fabs(vertex[k] - plane.at) < nudge_) x[k] = plane.at + plane.side * 0.01 * nudge_;
  }
  return x;
}

unsigned CrackSurfaces::hidden(const Vec<2>& from, std::span<const Vec<2>> places) const {
  // The cells of all lines; what a line only touches, or rounding puts beside it, is within the bins' margin.
  constexpr double touching = 1e-10;
  std::array<int, 2> low, high;
  for (std::size_t k = 0; k < 2; ++k) {
    double least = from[k], most = from[k];
    for (const Vec<2>& x : places) {
      least = std::min(least, x[k]);
      most = std::max(most, x[k]);
    }
    const double origin = model_.grid.origin[k], per_cell = model_.grid.inverse_cell[k];
    low[k] = static_cast<int>(std::floor((least - origin) * per_cell + touching));
    high[k] = std::max(low[k], static_cast<int>(std::ceil((most - origin) * per_cell - touching)) - 1);
  }
  static thread_local std::vector<FacetRef> room;
  const std::span<const FacetRef> facets = view_.bins.facets_of_box(low, high, room);
  unsigned hidden = 0;
  std::array<Crossing, 9> crossings;
  for (std::size_t f = 0; f < facets.size();) {
    const CrackId c = facets[f].crack;
    const std::size_t first = f;
    while (f < facets.size() && facets[f].crack == c) ++f;
    cross_stencil(view_.paths[c], facets.subspan(first, f - first), from, places, {crossings.data(), places.size()});
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (crossings[i].crosses()) hidden |= 1u << i;
    }
  }
  return hidden;
}

}  // namespace crampon
