#include "crampon/step/move_cracks.hpp"

#include <cmath>
#include <optional>

#include "crampon/core/parallel.hpp"
#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/point_fields.hpp"

namespace crampon {

namespace {

/// Centre-of-mass velocity of all fields at x, m/s; none when a node about has no mass: of the others alone it would be that of another place.
std::optional<Vec<2>> plane_velocity(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x) {
  Vec<2> sum{};
  double weight = 0;
  for (const PointNode& node : PointFields(work, model).nodes(x)) {
    const BlockLayers<2>& layers = work.nodes.layers[node.block];
    Pack p = splat(0.);
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (model.ignores_cracks(layers.node[l].field)) continue;
      p += work.nodes.momentum[layers.slot(l, node.local)];
    }
    if (!(p[2] > 0)) continue;
    for (int k = 0; k < 2; ++k) sum[k] += node.S * p[k] / p[2];
    weight += node.S;
  }
  if (weight < 1 - 1e-9) return std::nullopt;
  return sum;
}

/// Vertices without a displacement take that of the nearest vertex along the crack that has one; none has: they stay.
void fill_gaps(std::vector<std::optional<Vec<2>>>& moved) {
  const std::vector<std::optional<Vec<2>>> known = moved;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    for (std::size_t d = 1; !moved[i] && d < moved.size(); ++d) {
      if (i >= d && known[i - d]) {
        moved[i] = known[i - d];
      } else if (i + d < moved.size() && known[i + d]) {
        moved[i] = known[i + d];
      }
    }
    if (!moved[i]) moved[i] = Vec<2>{};
  }
}

/// A vertex that has drifted out from between its surface points goes back into their middle, along its normal. Where the faces have slid
/// past each other by more than a cell, what was opposite at the start no longer says where the plane is.
Vec<2> between_surfaces(const Crack<2>& crack, const Model<2>& model, std::size_t v) {
  const Vec<2> down = vertex_normal(crack, v);
  const double upper = dot(crack.upper[v] - crack.plane[v], down), lower = dot(crack.lower[v] - crack.plane[v], down);
  if ((upper <= 0 && lower >= 0) || std::fabs(opening_at(crack, v).sliding) > model.grid.smallest_cell()) return crack.plane[v];
  return crack.plane[v] + down * (0.5 * (upper + lower));
}

/// How far the points of a crack move; none: nothing says it.
struct CrackMotion {
  std::vector<std::optional<Vec<2>>> upper, lower, plane;
};

/// How far surface points are from where their carriers are.
std::vector<std::optional<Vec<2>>> surface_motion(const State<2>& state, const StepWork<2>& work, const std::vector<Vec<2>>& surface,
                                                  const std::vector<Vec<2>>& original, const Carriers& carriers, PositionTime time) {
  std::vector<std::optional<Vec<2>>> moved(surface.size());
  for (std::size_t v = 0; v < carriers.size(); ++v) {
    if (!carriers[v].empty()) moved[v] = original[v] + carried_displacement(state, work, carriers[v], time) - surface[v];
  }
  return moved;
}

/// Of the surfaces with their carriers, and of the plane with both of them.
CrackMotion carried_motion(const State<2>& state, const StepWork<2>& work, const Crack<2>& crack, PositionTime time) {
  CrackMotion m{surface_motion(state, work, crack.upper, crack.original, crack.upper_carriers, time),
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

void move_points(CrackMotion motion, Crack<2>& crack) {
  fill_gaps(motion.plane);
  for (std::size_t v = 0; v < crack.plane.size(); ++v) {
    crack.upper[v] += motion.upper[v] ? *motion.upper[v] : *motion.plane[v];
    crack.lower[v] += motion.lower[v] ? *motion.lower[v] : *motion.plane[v];
    if (!crack.fixed) crack.plane[v] += *motion.plane[v];
  }
}

void close_ends(Crack<2>& crack) {
  if (!crack.closed) return;
  for (auto* x : {&crack.plane, &crack.upper, &crack.lower}) x->back() = x->front();
}

void move_crack(const State<2>& state, const StepWork<2>& work, const Model<2>& model, double dt, Crack<2>& crack) {
  const std::size_t n = crack.plane.size();
  CrackMotion motion = carried_motion(state, work, crack, PositionTime::leading);
  parallel_for(n, model.threads, [&](std::size_t v) {
    if (const auto velocity = plane_velocity(work, model, crack.plane[v])) motion.plane[v] = *velocity * dt;
  });
  move_points(std::move(motion), crack);
  if (!crack.fixed) {
    std::vector<Vec<2>> between(n);
    for (std::size_t v = 0; v < n; ++v) between[v] = between_surfaces(crack, model, v);
    crack.plane = std::move(between);
  }
  close_ends(crack);
}

}  // namespace

CrackOpening opening_at(const Crack<2>& crack, std::size_t v) {
  const Vec<2> down = vertex_normal(crack, v), gap = crack.upper[v] - crack.lower[v];
  return {-dot(gap, down), dot(gap, Vec<2>{{-down[1], down[0]}})};
}

template <>
void move_cracks<2>(State<2>& state, StepWork<2>& work, const Model<2>& model) {
  const double dt = work.now.dt;
  for (Crack<2>& crack : state.cracks.list) move_crack(state, work, model, dt, crack);
}

template <>
void carry_cracks<2>(State<2>& state, StepWork<2>& work) {
  for (Crack<2>& crack : state.cracks.list) {
    move_points(carried_motion(state, work, crack, PositionTime::leading), crack);
    close_ends(crack);
  }
}

template <>
Crack<2> present_crack<2>(const State<2>& state, const StepWork<2>& work, Crack<2> crack) {
  if (state.particles.lead == 0) return crack;
  move_points(carried_motion(state, work, crack, PositionTime::present), crack);
  close_ends(crack);
  return crack;
}

// The input admits cracks in 2D only.
template <>
void move_cracks<3>(State<3>&, StepWork<3>&, const Model<3>&) {}
template <>
void carry_cracks<3>(State<3>&, StepWork<3>&) {}
template <>
Crack<3> present_crack<3>(const State<3>&, const StepWork<3>&, Crack<3> crack) {
  return crack;
}

}  // namespace crampon
