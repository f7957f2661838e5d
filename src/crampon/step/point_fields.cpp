#include "crampon/step/point_fields.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/step/assemble.hpp"

namespace crampon {

namespace {

/// Weights along one axis of a point without size. first: the lowest of `count` nodes.
struct AxisWeights {
  int first = 0, count = 0;
  std::array<double, most_nodes_along_axis> w{}, dw{};  ///< and slopes, per cell
};

AxisWeights linear_weights(double g) {
  AxisWeights out;
  out.first = static_cast<int>(std::floor(g));
  out.count = 2;
  out.w[0] = 1 - (g - out.first);
  out.w[1] = g - out.first;
  out.dw[0] = -1;
  out.dw[1] = 1;
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
  for (int n = 0; n < Shape::width; ++n) {
    out.w[static_cast<std::size_t>(n)] = N[n][0];
    out.dw[static_cast<std::size_t>(n)] = dN[n][0];
  }
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

PointNodes PointFields::nodes(const Vec<2>& x) const {
  const Grid<2>& grid = model_.grid;
  PointNodes out;
  const AxisWeights along[2] = {axis_weights(model_, (x[0] - grid.origin[0]) * grid.inverse_cell[0]),
                                axis_weights(model_, (x[1] - grid.origin[1]) * grid.inverse_cell[1])};
  for (int j = 0; j < along[1].count; ++j) {
    for (int i = 0; i < along[0].count; ++i) {
      const double S = along[0].w[i] * along[1].w[j];
      const IndexVector<2> node{along[0].first + i, along[1].first + j};
      if (S == 0 || node[0] < -block_side || node[1] < -block_side) continue;
      const IndexVector<2> block{Grid<2>::block_of(node[0]), Grid<2>::block_of(node[1])};
      if (block[0] >= grid.blocks[0] || block[1] >= grid.blocks[1]) continue;
      const std::uint32_t there = work_.blocks.of_number[static_cast<std::size_t>(grid.block_number(block))];
      const int local = (node[1] - Grid<2>::first_node(block[1])) * block_side + node[0] - Grid<2>::first_node(block[0]);
      if (there == no_block) continue;
      const Vec<2> G{{along[0].dw[i] * along[1].w[j] * grid.inverse_cell[0], along[0].w[i] * along[1].dw[j] * grid.inverse_cell[1]}};
      out.push_back({S, G, grid.node_position(node), there, local, 0});
    }
  }
  return out;
}

Vec<2> PointFields::beside(const Vec<2>& vertex, const Vec<2>& out) const {
  Vec<2> x = vertex + out * nudge_;
  for (const SymmetryPlane& plane : model_.symmetries) {
    const auto k = static_cast<std::size_t>(plane.axis);
    if (std::fabs(vertex[k] - plane.at) < nudge_) x[k] = plane.at + plane.side * 0.01 * nudge_;
  }
  return x;
}

/// f(crack, i) for every place i that a crack parts from `from`, by cracks, ascending.
template <class F>
void PointFields::for_crossings(const Vec<2>& from, std::span<const Vec<2>> places, F f) const {
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
  const std::span<const FacetRef> facets = work_.crack_view.bins.facets_of_box(low, high, room);
  std::array<Crossing, most_nodes_in_plane> crossings;
  for (std::size_t k = 0; k < facets.size();) {
    const CrackId c = facets[k].crack;
    const std::size_t first = k;
    while (k < facets.size() && facets[k].crack == c) ++k;
    cross_stencil(work_.crack_view.paths[c], facets.subspan(first, k - first), from, places, {crossings.data(), places.size()});
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (crossings[i].crosses()) f(c, i);
    }
  }
}

unsigned PointFields::hidden(const Vec<2>& from, std::span<const Vec<2>> places) const {
  unsigned hidden = 0;
  for_crossings(from, places, [&](CrackId, std::size_t i) { hidden |= 1u << i; });
  return hidden;
}

PointNodes PointFields::at(const Vec<2>& x, std::uint16_t field) const {
  const PointNodes about = nodes(x);
  std::array<Vec<2>, most_nodes_in_plane> places;
  for (std::size_t i = 0; i < about.size(); ++i) places[i] = about[i].x;
  std::array<Layer, most_nodes_in_plane> seen{};
  if (!work_.crack_view.paths.empty() && !model_.ignores_cracks(field)) {
    for_crossings(x, {places.data(), about.size()}, [&](CrackId c, std::size_t i) { seen[i].cracks.append(c); });
  }
  PointNodes out;
  for (std::size_t i = 0; i < about.size(); ++i) {
    PointNode node = about[i];
    seen[i].field = field;
    const BlockLayers<2>& layers = work_.nodes.layers[node.block];
    const int layer = layer_of<2>(layers.node, seen[i]);
    if (layer < 0) continue;
    node.slot = layers.slot(layer, node.local);
    if (work_.nodes.momentum[node.slot][2] > 0) out.push_back(node);
  }
  return out;
}

Vec<2> velocity_at(const StepWork<2>& work, const PointNodes& nodes) {
  Vec<2> v;
  for (const PointNode& node : nodes) {
    for (int k = 0; k < 2; ++k) v[static_cast<std::size_t>(k)] += node.S * work.nodes.velocity[node.slot][k];
  }
  return v;
}

std::array<Vec<2>, 2> velocity_gradient_at(const StepWork<2>& work, const PointNodes& nodes) {
  std::array<Vec<2>, 2> L{};
  for (const PointNode& node : nodes) {
    for (int d = 0; d < 2; ++d) {
      for (std::size_t k = 0; k < 2; ++k) L[static_cast<std::size_t>(d)][k] += work.nodes.velocity[node.slot][d] * node.G[k];
    }
  }
  return L;
}

}  // namespace crampon
