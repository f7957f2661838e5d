#include "crampon/step/move_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "crampon/core/parallel.hpp"
#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/point_fields.hpp"

namespace crampon {

namespace {

/// Centre-of-mass velocity of all fields at x, m/s; none when a node about has no mass: of the others alone it would be that of another place.
template <int Dim>
std::optional<Vec<Dim>> plane_velocity(const StepWork<Dim>& work, const Model<Dim>& model, const Vec<Dim>& x) {
  Vec<Dim> sum{};
  double weight = 0;
  for (const PointNode<Dim>& node : PointFields(work, model).nodes(x)) {
    const BlockLayers<Dim>& layers = work.nodes.layers[node.block];
    Pack p = splat(0.);
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (model.ignores_cracks(layers.node[l].field)) continue;
      p += work.nodes.momentum[layers.slot(l, node.local)];
    }
    if (!(p[Dim] > 0)) continue;
    for (int k = 0; k < Dim; ++k) sum[k] += node.S * p[k] / p[Dim];
    weight += node.S;
  }
  if (weight < 1 - 1e-9) return std::nullopt;
  return sum;
}

/// Vertices without a displacement take that of the nearest vertex along the facets that has one; of several as near, that of which the way starts
/// at the neighbour with the lowest number. Where none has, they stay.
template <int Dim>
void fill_gaps(const std::vector<Facet<Dim>>& facets, std::vector<std::optional<Vec<Dim>>>& moved) {
  const auto is_gap = [](const auto& displacement) { return !displacement; };
  for (bool spreads = true; spreads && std::any_of(moved.begin(), moved.end(), is_gap);) {
    const std::vector<std::optional<Vec<Dim>>> known = moved;  // one facet further each time
    std::vector<std::size_t> from(moved.size(), moved.size());
    for (const Facet<Dim>& facet : facets) {
      for (const VertexId v : facet) {
        for (const VertexId u : facet) {
          if (!known[v] && known[u] && u < from[v]) from[v] = u;
        }
      }
    }
    spreads = false;
    for (std::size_t v = 0; v < moved.size(); ++v) {
      if (from[v] < moved.size()) moved[v] = known[from[v]], spreads = true;
    }
  }
  for (auto& displacement : moved) {
    if (!displacement) displacement = Vec<Dim>{};
  }
}

/// A vertex that has drifted out from between its surface points goes back into their middle, along its normal. Where the faces have slid
/// past each other by more than a cell, what was opposite at the start no longer says where the plane is.
template <int Dim>
Vec<Dim> between_surfaces(const Crack<Dim>& crack, const Model<Dim>& model, std::size_t v, const Vec<Dim>& down) {
  const double upper = dot(crack.upper[v] - crack.plane[v], down), lower = dot(crack.lower[v] - crack.plane[v], down);
  const double sliding = OpeningFrame<Dim>(crack, v, down).opening.sliding;
  if ((upper <= 0 && lower >= 0) || std::fabs(sliding) > model.grid.smallest_cell()) return crack.plane[v];
  return crack.plane[v] + down * (0.5 * (upper + lower));
}

/// How far the points of a crack move; none: nothing says it.
template <int Dim>
struct CrackMotion {
  std::vector<std::optional<Vec<Dim>>> upper, lower, plane;
};

/// How far surface points are from where their carriers are.
template <int Dim>
std::vector<std::optional<Vec<Dim>>> surface_motion(const State<Dim>& state, const StepWork<Dim>& work,
                                                    const std::vector<Vec<Dim>>& surface, const std::vector<Vec<Dim>>& original,
                                                    const Carriers& carriers, PositionTime time) {
  std::vector<std::optional<Vec<Dim>>> moved(surface.size());
  for (std::size_t v = 0; v < carriers.size(); ++v) {
    if (!carriers[v].empty()) moved[v] = original[v] + carried_displacement(state, work, carriers[v], time) - surface[v];
  }
  return moved;
}

/// Of the surfaces with their carriers, and of the plane with both of them.
template <int Dim>
CrackMotion<Dim> carried_motion(const State<Dim>& state, const StepWork<Dim>& work, const Crack<Dim>& crack, PositionTime time) {
  CrackMotion<Dim> m{surface_motion(state, work, crack.upper, crack.original, crack.upper_carriers, time),
                     surface_motion(state, work, crack.lower, crack.original, crack.lower_carriers, time),
                     {}};
  for (std::size_t v = 0; v < crack.plane.size(); ++v) {
    if (m.upper[v] && m.lower[v]) {
      m.plane.emplace_back((*m.upper[v] + *m.lower[v]) * 0.5);
    } else {
      m.plane.push_back(m.upper[v] ? m.upper[v] : m.lower[v]);
    }
  }
  return m;
}

template <int Dim>
void move_points(CrackMotion<Dim> motion, Crack<Dim>& crack) {
  fill_gaps<Dim>(crack.facets, motion.plane);
  for (std::size_t v = 0; v < crack.plane.size(); ++v) {
    crack.upper[v] += motion.upper[v] ? *motion.upper[v] : *motion.plane[v];
    crack.lower[v] += motion.lower[v] ? *motion.lower[v] : *motion.plane[v];
    if (!crack.fixed) crack.plane[v] += *motion.plane[v];
  }
}

template <int Dim>
void close_ends(Crack<Dim>& crack) {
  if (!crack.closed) return;
  for (auto* x : {&crack.plane, &crack.upper, &crack.lower}) x->back() = x->front();
}

template <int Dim>
void move_crack(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, double dt, Crack<Dim>& crack) {
  const std::size_t n = crack.plane.size();
  CrackMotion<Dim> motion = carried_motion(state, work, crack, PositionTime::leading);
  parallel_for(n, model.threads, [&](std::size_t v) {
    if (const auto velocity = plane_velocity(work, model, crack.plane[v])) motion.plane[v] = *velocity * dt;
  });
  move_points(std::move(motion), crack);
  if (!crack.fixed) {
    const std::vector<Vec<Dim>> normals = vertex_normals(crack);
    std::vector<Vec<Dim>> between(n);
    for (std::size_t v = 0; v < n; ++v) between[v] = between_surfaces(crack, model, v, normals[v]);
    crack.plane = std::move(between);
  }
  close_ends(crack);
}

}  // namespace

template <int Dim>
std::vector<CrackOpening> openings_of(const Crack<Dim>& crack) {
  const std::vector<Vec<Dim>> normals = vertex_normals(crack);
  std::vector<CrackOpening> openings;
  openings.reserve(normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) openings.push_back(OpeningFrame<Dim>(crack, v, normals[v]).opening);
  return openings;
}

template <int Dim>
void move_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const double dt = work.now.dt;
  for (Crack<Dim>& crack : state.cracks.list) move_crack(state, work, model, dt, crack);
}

template <int Dim>
void carry_cracks(State<Dim>& state, StepWork<Dim>& work) {
  for (Crack<Dim>& crack : state.cracks.list) {
    move_points(carried_motion(state, work, crack, PositionTime::leading), crack);
    close_ends(crack);
  }
}

template <int Dim>
Crack<Dim> present_crack(const State<Dim>& state, const StepWork<Dim>& work, Crack<Dim> crack) {
  if (state.particles.lead == 0) return crack;
  move_points(carried_motion(state, work, crack, PositionTime::present), crack);
  close_ends(crack);
  return crack;
}

#define CRAMPON_INSTANTIATE(DIM)                                                  \
  template std::vector<CrackOpening> openings_of<DIM>(const Crack<DIM>&);         \
  template void move_cracks<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&); \
  template void carry_cracks<DIM>(State<DIM>&, StepWork<DIM>&);                   \
  template Crack<DIM> present_crack<DIM>(const State<DIM>&, const StepWork<DIM>&, Crack<DIM>);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
