#include "crampon/step/move_cracks.hpp"

#include <cmath>
#include <optional>

#include "crampon/core/parallel.hpp"
#include "crampon/step/crack_surfaces.hpp"

namespace crampon {

namespace {

/// Centre-of-mass velocity of all fields around x; none when no node there has mass.
std::optional<Vec<2>> plane_velocity(const State<2>& state, const Model<2>& model, const Vec<2>& x) {
  Vec<2> sum{};
  double weight = 0;
  for (const NodeShare& node : nodes_around(state, model, x)) {
    const BlockLayers<2>& layers = state.nodes.layers[node.block];
    Pack p = splat(0.);
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (model.is_whole(layers.node[l].field)) continue;
      p += state.nodes.momentum[layers.slot(l, node.local)];
    }
    if (!(p[2] > 0)) continue;
    for (int k = 0; k < 2; ++k) sum[k] += node.S * p[k] / p[2];
    weight += node.S;
  }
  if (!(weight > 0)) return std::nullopt;
  return sum * (1 / weight);
}

/// The same for one surface: of the fields of that side.
std::optional<Vec<2>> surface_velocity(const SurfaceNodes& nodes) {
  if (nodes.empty()) return std::nullopt;
  Vec<2> v{};
  for (const SurfaceNode& on : nodes) {
    for (int k = 0; k < 2; ++k) v[k] += on.weight * on.p[k] / on.p[2];
  }
  return v;
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
  const CrackSurfaces surfaces(state, model);
  struct Motion {
    std::vector<std::optional<Vec<2>>> plane, upper, lower;
  };
  std::vector<Motion> motion(state.cracks.size());
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    const std::size_t n = crack.plane.size();
    motion[c].plane.resize(n);
    motion[c].upper.resize(n);
    motion[c].lower.resize(n);
    parallel_for(n, model.threads, [&](std::size_t v) {
      motion[c].plane[v] = plane_velocity(state, model, crack.plane[v]);
      const CrackSurfaces::Faces faces = surfaces.faces(crack, v);
      motion[c].upper[v] = surface_velocity(faces.upper);
      motion[c].lower[v] = surface_velocity(faces.lower);
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
