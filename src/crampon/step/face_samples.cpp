#include "crampon/step/face_samples.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/contact/separation.hpp"
#include "crampon/geometry/way_out.hpp"

namespace crampon {

namespace {

/// Does x see an edge or a corner of the body, or a side that curves as sharply: does the normal turn with x as about a point of the surface? Or
/// does the surface end before the point of it that x takes for the nearest?
template <int Dim>
bool sees_edge(const RigidBody<Dim>& body, const RigidPose<Dim>& pose, const Vec<Dim>& x, const RigidFaceView<Dim>& view, double cell) {
  if (!is_surface(body, pose, x, view, cell)) return true;
  if (view.distance < 1e-6 * cell) return false;
  return turn_along_face(body, pose, x, view, 1e-3 * std::fmin(view.distance, cell)) * view.distance > 0.5;
}

/// The way along n from the middle of a particle to its body's surface, m, where another side of the body is nearer; none within a cell and a half.
template <int Dim>
std::optional<double> way_to_surface(const State<Dim>& state, const Model<Dim>& model, const CloudPoint<Dim>& point, const Vec<Dim>& n) {
  const std::array<Vec<Dim>, Dim> F = since_start<Dim>(model, state.particles.id[point.particle], point.F);
  Vec<Dim> line, stretched;
  for (int k = 0; k < Dim; ++k) line[k] = dot(F[k], n);
  line = normalized(line);
  Vec<3> from, to;
  for (int k = 0; k < Dim; ++k) {
    stretched += F[k] * line[k];
    from[static_cast<std::size_t>(k)] = state.particles.original[point.particle][k];
    to[static_cast<std::size_t>(k)] = line[k];
  }
  const double cell = model.grid.smallest_cell();
  const auto way = way_out(*model.shapes[state.particles.body[point.particle]], from, to, 1.5 * cell, 1e-9 * cell);
  if (!way) return std::nullopt;
  return *way * norm(stretched);
}

}  // namespace

template <int Dim>
void FaceSampler<Dim>::sample(const FaceGroup<Dim>& group, const std::size_t* slots, const FacePart<Dim>& part,
                              const std::vector<CloudPoint<Dim>>& points, std::vector<FaceSample<Dim>>& out) const {
  const bool unknown = std::any_of(points.begin(), points.end(), [&](const CloudPoint<Dim>& point) {
    return std::isnan(model_.surface[state_.particles.id[point.particle]][0]);
  });
  if (unknown && model_.grid.has_even_cells()) {
    sample_sums(group, slots, part, out);
  } else {
    sample_particles(part, points, out);
  }
}

template <int Dim>
RigidFaceView<Dim> FaceSampler<Dim>::see(const FacePart<Dim>& part, const Vec<Dim>& x) const {
  return see_face(model_.rigid_bodies[part.body], state_.rigid[part.body].start, x);
}

/// Normal and gap between the surface of a body and a rigid face, as a particle at x sees them. The nearest point of the body's surface is
/// x + to_surface. There are three cases. If the particle sees an edge of the rigid body, the normal is that of the body's surface, and the
/// gap is the distance of that surface point from the rigid body. If the body's surface faces the rigid one, the normal is that of the
/// rigid face, and the gap is the particle's distance less the depth of its surface. If the nearest surface is another side of the body,
/// the depth is taken along the rigid face's normal instead.
template <int Dim>
template <class Along>
std::optional<FaceSample<Dim>> FaceSampler<Dim>::before_face(const FacePart<Dim>& part, const Vec<Dim>& x, const Vec<Dim>& to_surface,
                                                             Along along) const {
  const RigidFaceView<Dim> view = see(part, x);
  if (view.out == Vec<Dim>{}) return std::nullopt;
  const Vec<Dim> n = -view.out;
  const double depth = dot(to_surface, n);
  const bool facing = depth > of_one_face * norm(to_surface);
  const RigidBody<Dim>& body = model_.rigid_bodies[part.body];
  if (sees_edge(body, state_.rigid[part.body].start, x, view, model_.grid.smallest_cell()))
    return FaceSample<Dim>{0, see(part, x + to_surface).distance, normalized(to_surface), true};
  if (facing) return FaceSample<Dim>{0, view.distance - depth, n, false};
  const auto way = along(n);
  if (!way) return std::nullopt;
  return FaceSample<Dim>{0, view.distance - *way, n, false};
}

/// Where nobody knows the surface of the particles' body, their mean position tells of its edge, as between bodies (docs/theory/contact.md,
/// detection): smoother than their outlines.
template <int Dim>
void FaceSampler<Dim>::sample_sums(const FaceGroup<Dim>& group, const std::size_t* slots, const FacePart<Dim>& part,
                                   std::vector<FaceSample<Dim>>& out) const {
  Vec<Dim> mean;
  for (std::uint32_t s = group.first_slot; s < group.end_slot; ++s) mean += work_.nodes.contact[slots[s]].present();
  mean = mean * (1 / group.m);
  const auto to_edge = [&](const Vec<Dim>& n) {
    const PlaneInCells plane = plane_in_cells(model_.grid.cell, n);
    return -model_.contact.fields[part.field].edge.edge_distance(-dot(mean, n) / plane.h, plane) * plane.h - dot(mean, n);
  };
  const Vec<Dim> out_of_material = normalized(part.gradient);
  if (out_of_material == Vec<Dim>{}) return;
  auto sample = before_face(part, group.x + mean, out_of_material * to_edge(out_of_material),
                            [&](const Vec<Dim>& n) { return std::optional(to_edge(n)); });
  if (!sample) return;
  // Near the end of a body's side its gradient leans, and the way along it is not the way along n.
  if (!sample->edge) sample->gap = see(part, group.x + mean).distance - to_edge(sample->n);
  sample->S = dot(part.gradient, sample->n);
  if (sample->S > 0) out.push_back(*sample);
}

template <int Dim>
void FaceSampler<Dim>::sample_particles(const FacePart<Dim>& part, const std::vector<CloudPoint<Dim>>& points,
                                        std::vector<FaceSample<Dim>>& out) const {
  for (CloudPoint<Dim> point : points) {
    const std::uint8_t mirrored = point.mirrored;
    for (int k = 0; k < Dim; ++k) {  // itself, not its image
      if (mirrored >> k & 1u) point.mirror(k);
    }
    const Vec<Dim> x = state_.particles.position(point.particle);
    std::optional<FaceSample<Dim>> sample;
    if (std::isnan(point.to_surface[0])) {  // nobody knows: the particle's own outline
      const RigidFaceView<Dim> view = see(part, x);
      double half = 0;
      for (const Vec<Dim>& r : point.half_edges()) half += std::fabs(dot(view.out, r));
      sample = FaceSample<Dim>{0, view.distance - half, -view.out, false};
    } else if (point.to_surface != Vec<Dim>{}) {
      sample = before_face(part, x, point.to_surface, [&](const Vec<Dim>& n) { return way_to_surface(state_, model_, point, n); });
    }
    if (!sample || sample->n == Vec<Dim>{}) continue;
    sample->S = point.S;
    for (int k = 0; k < Dim; ++k) {
      if (mirrored >> k & 1u) sample->n[k] = -sample->n[k];
    }
    out.push_back(*sample);
  }
}

template class FaceSampler<2>;
template class FaceSampler<3>;

}  // namespace crampon
