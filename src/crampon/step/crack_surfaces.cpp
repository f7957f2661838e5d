#include "crampon/step/crack_surfaces.hpp"

#include <cmath>

namespace crampon {

namespace {

/// Cells between a vertex of the plane and its surface points up to which the bins know all segments between them.
constexpr int surface_reach = 2;

/// Weights along one axis of a point without size: linear, or quadratic B-spline. first: the lowest of `width` nodes.
struct AxisWeights {
  int first = 0;
  std::array<double, 3> w{};

  AxisWeights(double g, bool bspline) {
    if (!bspline) {
      first = static_cast<int>(std::floor(g));
      w = {1 - (g - first), g - first, 0};
      return;
    }
    first = static_cast<int>(std::floor(g - 0.5));
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
  return normalized(n);
}

std::array<NodeShare, 9> nodes_around(const State<2>& state, const Model<2>& model, const Vec<2>& x) {
  const Grid<2>& grid = model.grid;
  std::array<NodeShare, 9> out;
  const bool bspline = by_bsplines(model);
  const AxisWeights along_x((x[0] - grid.origin[0]) * grid.inverse_cell[0], bspline);
  const AxisWeights along_y((x[1] - grid.origin[1]) * grid.inverse_cell[1], bspline);
  for (int n = 0; n < 9; ++n) {
    const IndexVector<2> node{along_x.first + n % 3, along_y.first + n / 3};
    out[n].S = along_x.w[n % 3] * along_y.w[n / 3];
    if (out[n].S == 0) continue;
    out[n].x = grid.node_position(node);
    IndexVector<2> block{};
    int local = 0, stride = 1;
    bool inside = true;
    for (int k = 0; k < 2; ++k) {
      if (node[k] < -block_side) {
        inside = false;
        break;
      }
      block[k] = Grid<2>::block_of(node[k]);
      inside = inside && block[k] < grid.blocks[k];
      local += (node[k] - Grid<2>::first_node(block[k])) * stride;
      stride *= block_side;
    }
    if (!inside) continue;
    out[n].block = state.blocks.of_number[static_cast<std::size_t>(grid.block_number(block))];
    out[n].local = local;
  }
  return out;
}

CrackSurfaces::CrackSurfaces(const State<2>& state, const Model<2>& model)
    : state_(state), model_(model), nudge_(1e-8 * model.grid.smallest_cell()) {
  for (const Crack<2>& crack : state.cracks.list) paths_.push_back({crack.plane, {}, crack.closed, {}});
  bins_.build({model.grid.origin, model.grid.cell, model.grid.cells, surface_reach, surface_reach}, paths_);
}

Vec<2> CrackSurfaces::off_mirrors(Vec<2> x, const Vec<2>& vertex) const {
  for (const SymmetryPlane& plane : model_.symmetries) {
    const auto k = static_cast<std::size_t>(plane.axis);
    if (std::fabs(vertex[k] - plane.at) < nudge_) x[k] = plane.at + plane.side * nudge_;
  }
  return x;
}

Vec<2> CrackSurfaces::seen_from(const Crack<2>& crack, std::size_t v, const Vec<2>& surface, double side) const {
  const Vec<2> out = vertex_normal(crack, v) * side;  // from the plane to the surface
  const Vec<2> beside = off_mirrors(crack.plane[v] + out * nudge_, crack.plane[v]);
  if (!(dot(surface - crack.plane[v], out) > nudge_)) return beside;
  const Vec<2> itself = off_mirrors(surface, crack.plane[v]);
  Signature between;
  const bool sees = signatures(beside, {&itself, 1}, within_reach(beside, itself), &between) == 0;
  return sees && between.empty() ? itself : beside;
}
Vec<2> CrackSurfaces::above(const Crack<2>& crack, std::size_t v) const { return seen_from(crack, v, crack.upper[v], -1); }
Vec<2> CrackSurfaces::below(const Crack<2>& crack, std::size_t v) const { return seen_from(crack, v, crack.lower[v], 1); }

SurfaceNodes CrackSurfaces::nodes(const Vec<2>& from, const Vec<2>& x) const {
  SurfaceNodes out;
  std::array<Vec<2>, 9> places;
  std::array<Signature, 9> sides;
  std::size_t count = 0;
  for (const NodeShare& node : nodes_around(state_, model_, x)) {
    if (node.block == no_block || node.S == 0) continue;
    out.list_[count].node = node;
    places[count++] = node.x;
  }
  const unsigned too_many = signatures(from, {places.data(), count}, within_reach(from, x), sides.data());
  double mass = 0, shape = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (too_many >> i & 1u) continue;
    SurfaceNode& on = out.list_[out.count_];
    on = {out.list_[i].node, sides[i], splat(0.), 0};
    for_layers(on.node, on.side, [&](std::size_t slot) { on.p += state_.nodes.momentum[slot]; });
    if (!(on.p[2] > 0)) continue;
    mass += on.node.S * on.p[2];
    shape += on.node.S;
    ++out.count_;
  }
  const double light = 0.5 * mass / shape;
  double sum = 0;
  for (std::size_t i = 0; i < out.count_; ++i) {
    SurfaceNode& on = out.list_[i];
    sum += on.weight = on.node.S * std::fmin(1., on.p[2] / light);
  }
  for (std::size_t i = 0; i < out.count_; ++i) out.list_[i].weight /= sum;
  return out;
}

bool CrackSurfaces::within_reach(const Vec<2>& from, const Vec<2>& x) const {
  const Grid<2>& grid = model_.grid;
  const auto cell_of = [&](int k, double coordinate) {
    return static_cast<int>(std::floor((coordinate - grid.origin[k]) * grid.inverse_cell[k]));
  };
  for (int k = 0; k < 2; ++k) {
    if (std::abs(cell_of(k, x[k]) - cell_of(k, from[k])) > surface_reach - (by_bsplines(model_) ? 1 : 0)) return false;
  }
  return true;
}

unsigned CrackSurfaces::signatures(const Vec<2>& from, std::span<const Vec<2>> places, bool near, Signature* sides) const {
  unsigned too_many = 0;
  std::array<Crossing, 9> crossings;
  const auto book = [&](std::size_t c) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (crossings[i].crosses() && !sides[i].append(static_cast<CrackId>(c))) too_many |= 1u << i;
    }
  };
  if (!near) {
    for (std::size_t c = 0; c < paths_.size(); ++c) {
      for (std::size_t i = 0; i < places.size(); ++i) crossings[i] = cross_path(paths_[c], from, places[i]);
      book(c);
    }
    return too_many;
  }
  const Grid<2>& grid = model_.grid;
  const auto cell_of = [&](int k) { return static_cast<int>(std::floor((from[k] - grid.origin[k]) * grid.inverse_cell[k])); };
  const auto facets = bins_.facets_of_cell(cell_of(0), cell_of(1));
  for (std::size_t f = 0; f < facets.size();) {
    const CrackId c = facets[f].crack;
    const std::size_t first = f;
    while (f < facets.size() && facets[f].crack == c) ++f;
    cross_stencil(paths_[c], facets.subspan(first, f - first), from, places, {crossings.data(), places.size()});
    book(c);
  }
  return too_many;
}

}  // namespace crampon
