#include "crampon/step/crack_surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {

namespace {

/// Weights along one axis of a point without size. first: the lowest of `count` nodes.
struct AxisWeights {
  int first = 0, count = 0;
  std::array<double, most_nodes_along_axis> w{};
};

AxisWeights linear_weights(double g) {
  AxisWeights out;
  out.first = static_cast<int>(std::floor(g));
  out.count = 2;
  out.w[0] = 1 - (g - out.first);
  out.w[1] = g - out.first;
  return out;
}

template <class Shape>
AxisWeights weights_of(double g) {
  AxisWeights out;
  const double from_lowest = g + (Shape::bin_shift - Shape::below), first = std::floor(from_lowest);
  Pack N[Shape::width], dN[Shape::width];
  Shape::weights(splat(from_lowest - first), 0., 1., N, dN);
  out.first = static_cast<int>(first);
  out.count = Shape::width;
  for (int n = 0; n < Shape::width; ++n) out.w[static_cast<std::size_t>(n)] = N[n][0];
  return out;
}

/// g: place along the axis, in cells from the grid's origin. Functions of particles with a size are linear functions when the size is none.
AxisWeights axis_weights(const Model<2>& model, double g) {
  if (model.crack_shape_functions == CrackShapeFunctions::linear) return linear_weights(g);
  return with_shape(model.shape_functions, [g]<class Shape>(std::type_identity<Shape>) {
    if constexpr (Shape::boxes.of_points() && Shape::boxes.cell > 2) {
      return weights_of<Shape>(g);
    } else {
      return linear_weights(g);
    }
  });
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
  const AxisWeights along[2] = {axis_weights(model, (x[0] - grid.origin[0]) * grid.inverse_cell[0]),
                                axis_weights(model, (x[1] - grid.origin[1]) * grid.inverse_cell[1])};
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
  std::array<Crossing, most_nodes_in_plane> crossings;
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
