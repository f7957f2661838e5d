#include "crampon/step/move_cracks.hpp"

#include <cmath>
#include <optional>

#include "crampon/core/parallel.hpp"
#include "crampon/crack/crossing.hpp"
#include "crampon/crack/facet_bins.hpp"

namespace crampon {

namespace {

/// Unit normal at a vertex, from above to below: the mean of the segments that meet there.
Vec<2> vertex_normal(const Crack<2>& crack, std::size_t v) {
  const std::size_t last = crack.plane.size() - 1;
  Vec<2> n{};
  if (v > 0 || crack.closed) n += segment_normal(crack.plane[v > 0 ? v - 1 : last - 1], crack.plane[v > 0 ? v : last]);
  if (v < last || crack.closed) n += segment_normal(crack.plane[v < last ? v : 0], crack.plane[v < last ? v + 1 : 1]);
  return normalized(n);
}

/// Cells between a vertex of the plane and its surface points up to which the bins know all segments between them.
constexpr int surface_reach = 2;

/// A node as a crack vertex sees it: S and the node's place in the arrays.
struct NodeShare {
  double S = 0;
  Vec<2> x;
  std::uint32_t block = no_block;
  int local = 0;
};

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

/// The nodes that S reaches from x; those out of reach have S = 0.
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

/// Centre-of-mass velocity of all fields around x; none when no node there has mass.
std::optional<Vec<2>> plane_velocity(const State<2>& state, const Model<2>& model, const Vec<2>& x) {
  Vec<2> sum{};
  double weight = 0;
  for (const NodeShare& node : nodes_around(state, model, x)) {
    if (node.block == no_block || node.S == 0) continue;
    const BlockLayers<2>& layers = state.nodes.layers[node.block];
    Pack p = splat(0.);
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (model.is_rigid(layers.node[l].field)) continue;
      p += state.nodes.momentum[(layers.node_begin + l) * block_nodes<2> + node.local];
    }
    if (!(p[2] > 0)) continue;
    for (int k = 0; k < 2; ++k) sum[k] += node.S * p[k] / p[2];
    weight += node.S;
  }
  if (!(weight > 0)) return std::nullopt;
  return sum * (1 / weight);
}

/// The same for one surface: at every node the field of that side. The side is found from the vertex of the plane, moved a little to it:
/// a surface point itself may lie a hair beyond the plane while the crack is closed, and would then go with the wrong side for good.
/// Weights are those of the plane, S alone: where faces press on each other they share the normal velocity at every node, and both
/// surfaces then move as one; weights by mass (fracture.md 6.4) let them drift by the strain over a third of a cell.
std::optional<Vec<2>> surface_velocity(const State<2>& state, const Model<2>& model, const std::vector<CrackPath>& paths,
                                       const FacetBins& bins, const Vec<2>& from, const Vec<2>& x) {
  const Grid<2>& grid = model.grid;
  Vec<2> sum{};
  double weight = 0;
  const auto cell_of = [&](int k, double coordinate) {
    return static_cast<int>(std::floor((coordinate - grid.origin[k]) * grid.inverse_cell[k]));
  };
  const auto facets = bins.facets_of_cell(cell_of(0, from[0]), cell_of(1, from[1]));
  bool within_reach = true;
  for (int k = 0; k < 2; ++k)
    within_reach = within_reach && std::abs(cell_of(k, x[k]) - cell_of(k, from[k])) <= surface_reach - (by_bsplines(model) ? 1 : 0);
  for (const NodeShare& node : nodes_around(state, model, x)) {
    if (node.block == no_block || node.S == 0) continue;
    Signature signature;
    bool fits = true;
    if (within_reach) {
      for (std::size_t f = 0; f < facets.size();) {
        const CrackId c = facets[f].crack;
        const std::size_t first = f;
        while (f < facets.size() && facets[f].crack == c) ++f;
        if (cross_path(paths[c], facets.subspan(first, f - first), from, node.x).crosses()) fits = signature.append(c) && fits;
      }
    } else {
      for (std::size_t c = 0; c < paths.size(); ++c) {
        if (cross_path(paths[c], from, node.x).crosses()) fits = signature.append(static_cast<CrackId>(c)) && fits;
      }
    }
    const BlockLayers<2>& layers = state.nodes.layers[node.block];
    Pack p = splat(0.);  // of all materials on that side (N13 sec. 2.9)
    for (std::size_t l = 0; l < layers.node.size() && fits; ++l) {
      if (layers.node[l].cracks == signature && !model.is_rigid(layers.node[l].field))
        p += state.nodes.momentum[(layers.node_begin + l) * block_nodes<2> + node.local];
    }
    if (!(p[2] > 0)) continue;
    for (int k = 0; k < 2; ++k) sum[k] += node.S * p[k] / p[2];
    weight += node.S;
  }
  if (!(weight > 0)) return std::nullopt;
  return sum * (1 / weight);
}

/// Vertices without a velocity take that of the nearest vertex along the crack that has one; none has: they stay.
void fill_gaps(std::vector<std::optional<Vec<2>>>& v) {
  const std::vector<std::optional<Vec<2>>> known = v;
  for (std::size_t i = 0; i < v.size(); ++i) {
    for (std::size_t d = 1; !v[i] && d < v.size(); ++d) {
      if (i >= d && known[i - d]) {
        v[i] = known[i - d];
      } else if (i + d < v.size() && known[i + d]) {
        v[i] = known[i + d];
      }
    }
  }
}

/// Faces in contact do not cross the plane between them; what is beyond it is the drift of a surface point that was open for long,
/// and is taken back (fracture.md 6.4, "no plane crossing").
void keep_sides(Crack<2>& crack) {
  for (std::size_t v = 0; v < crack.plane.size(); ++v) {
    const Vec<2> down = vertex_normal(crack, v);
    const double upper = dot(crack.upper[v] - crack.plane[v], down), lower = dot(crack.lower[v] - crack.plane[v], down);
    if (upper > 0) crack.upper[v] -= down * upper;
    if (lower < 0) crack.lower[v] -= down * lower;
  }
}

}  // namespace

CrackOpening opening_at(const Crack<2>& crack, std::size_t v) {
  const Vec<2> down = vertex_normal(crack, v), gap = crack.upper[v] - crack.lower[v];
  return {-dot(gap, down), dot(gap, Vec<2>{{-down[1], down[0]}})};
}

template <>
void move_cracks<2>(State<2>& state, const Model<2>& model, double dt) {
  if (state.cracks.empty()) return;
  std::vector<CrackPath> paths;
  for (const Crack<2>& crack : state.cracks.list) paths.push_back({crack.plane, {}, crack.closed, {}});
  FacetBins bins;
  bins.build({model.grid.origin, model.grid.cell, model.grid.cells, surface_reach, surface_reach}, paths);

  struct Motion {
    std::vector<std::optional<Vec<2>>> plane, upper, lower;
  };
  std::vector<Motion> motion(state.cracks.size());
  const double nudge = 1e-8 * model.grid.smallest_cell();
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    const std::size_t n = crack.plane.size();
    motion[c].plane.resize(n);
    motion[c].upper.resize(n);
    motion[c].lower.resize(n);
    parallel_for(n, model.threads, [&](std::size_t v) {
      const Vec<2> down = vertex_normal(crack, v);
      motion[c].plane[v] = plane_velocity(state, model, crack.plane[v]);
      motion[c].upper[v] = surface_velocity(state, model, paths, bins, crack.plane[v] - down * nudge, crack.upper[v]);
      motion[c].lower[v] = surface_velocity(state, model, paths, bins, crack.plane[v] + down * nudge, crack.lower[v]);
    });
    fill_gaps(motion[c].plane);
    for (std::size_t v = 0; v < n; ++v) {
      if (!motion[c].upper[v]) motion[c].upper[v] = motion[c].plane[v];
      if (!motion[c].lower[v]) motion[c].lower[v] = motion[c].plane[v];
    }
  }
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    Crack<2>& crack = state.cracks.list[c];
    const auto advance = [&](std::vector<Vec<2>>& x, const std::vector<std::optional<Vec<2>>>& v) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (v[i]) x[i] += *v[i] * dt;
      }
    };
    if (!crack.fixed) advance(crack.plane, motion[c].plane);
    advance(crack.upper, motion[c].upper);
    advance(crack.lower, motion[c].lower);
    const bool faces_meet = !std::holds_alternative<NoContact>(model.crack_laws[c]);
    if (faces_meet && !crack.fixed) keep_sides(crack);
    if (crack.closed) {
      for (auto* x : {&crack.plane, &crack.upper, &crack.lower}) x->back() = x->front();
    }
  }
}

template <>
void move_cracks<3>(State<3>&, const Model<3>&, double) {}  // the input admits cracks in 2D only

}  // namespace crampon
