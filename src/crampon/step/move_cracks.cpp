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

/// A node as a crack vertex sees it: linear S and the node's place in the arrays.
struct NodeShare {
  double S = 0;
  Vec<2> x;
  std::uint32_t block = no_block;
  int local = 0;
};

std::array<NodeShare, 4> nodes_around(const State<2>& state, const Grid<2>& grid, const Vec<2>& x) {
  std::array<NodeShare, 4> out;
  IndexVector<2> cell{};
  double f[2];
  for (int k = 0; k < 2; ++k) {
    const double g = (x[k] - grid.origin[k]) * grid.inverse_cell[k];
    cell[k] = static_cast<int>(std::floor(g));
    f[k] = g - cell[k];
  }
  for (int n = 0; n < 4; ++n) {
    const IndexVector<2> node{cell[0] + n % 2, cell[1] + n / 2};
    out[n].S = (n % 2 ? f[0] : 1 - f[0]) * (n / 2 ? f[1] : 1 - f[1]);
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
std::optional<Vec<2>> plane_velocity(const State<2>& state, const Grid<2>& grid, const Vec<2>& x) {
  Vec<2> sum{};
  double weight = 0;
  for (const NodeShare& node : nodes_around(state, grid, x)) {
    if (node.block == no_block || node.S == 0) continue;
    const BlockLayers<2>& layers = state.nodes.layers[node.block];
    Pack p = splat(0.);
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      p += state.nodes.momentum[(layers.node_begin + l) * block_nodes<2> + node.local];
    }
    if (!(p[2] > 0)) continue;
    for (int k = 0; k < 2; ++k) sum[k] += node.S * p[k] / p[2];
    weight += node.S;
  }
  if (!(weight > 0)) return std::nullopt;
  return sum * (1 / weight);
}

/// The same for one surface: at every node the field to which the line from the surface point belongs.
std::optional<Vec<2>> surface_velocity(const State<2>& state, const Grid<2>& grid, const std::vector<CrackPath>& paths,
                                       const FacetBins& bins, const Vec<2>& x) {
  Vec<2> sum{};
  double mass = 0;
  const auto facets = bins.facets_of_cell(static_cast<int>(std::floor((x[0] - grid.origin[0]) * grid.inverse_cell[0])),
                                          static_cast<int>(std::floor((x[1] - grid.origin[1]) * grid.inverse_cell[1])));
  for (const NodeShare& node : nodes_around(state, grid, x)) {
    if (node.block == no_block || node.S == 0) continue;
    Signature signature;
    bool fits = true;
    for (std::size_t f = 0; f < facets.size();) {
      const CrackId c = facets[f].crack;
      const std::size_t first = f;
      while (f < facets.size() && facets[f].crack == c) ++f;
      if (cross_path(paths[c], facets.subspan(first, f - first), x, node.x).crosses()) fits = signature.append(c) && fits;
    }
    const BlockLayers<2>& layers = state.nodes.layers[node.block];
    for (std::size_t l = 0; l < layers.node.size() && fits; ++l) {
      if (layers.node[l] != signature) continue;
      const Pack p = state.nodes.momentum[(layers.node_begin + l) * block_nodes<2> + node.local];
      for (int k = 0; k < 2; ++k) sum[k] += node.S * p[k];
      mass += node.S * p[2];
    }
  }
  if (!(mass > 0)) return std::nullopt;
  return sum * (1 / mass);
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
  bins.build({model.grid.origin, model.grid.cell, model.grid.cells, 0, 0}, paths);

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
      motion[c].plane[v] = plane_velocity(state, model.grid, crack.plane[v]);
      const Vec<2> up = crack.upper[v] - down * nudge, low = crack.lower[v] + down * nudge;
      motion[c].upper[v] = surface_velocity(state, model.grid, paths, bins, up);
      motion[c].lower[v] = surface_velocity(state, model.grid, paths, bins, low);
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
    if (crack.closed) {
      for (auto* x : {&crack.plane, &crack.upper, &crack.lower}) x->back() = x->front();
    }
  }
}

template <>
void move_cracks<3>(State<3>&, const Model<3>&, double) {}  // the input admits cracks in 2D only

}  // namespace crampon
