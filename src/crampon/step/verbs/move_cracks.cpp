#include <cmath>
#include <optional>

#include "crampon/core/parallel.hpp"
#include "crampon/step/crack_motion.hpp"
#include "crampon/step/point_fields.hpp"
#include "crampon/step/verbs.hpp"

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

/// A vertex that has drifted out from between its surface points goes back into their middle, along its normal. Where the faces have slid
/// past each other by more than a cell, what was opposite at the start no longer says where the plane is.
template <int Dim>
Vec<Dim> between_surfaces(const Crack<Dim>& crack, const Model<Dim>& model, std::size_t v, const Vec<Dim>& down) {
  const double upper = dot(crack.upper[v] - crack.plane[v], down), lower = dot(crack.lower[v] - crack.plane[v], down);
  const double sliding = OpeningFrame<Dim>(crack, v, down).opening.sliding;
  if ((upper <= 0 && lower >= 0) || std::fabs(sliding) > model.grid.smallest_cell()) return crack.plane[v];
  return crack.plane[v] + down * (0.5 * (upper + lower));
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
void move_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const double dt = work.now.dt;
  for (Crack<Dim>& crack : state.cracks.list) move_crack(state, work, model, dt, crack);
}

template void move_cracks<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void move_cracks<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
