#include "crampon/run/surfaces_at_start.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "crampon/contact/find_pairs.hpp"
#include "crampon/geometry/combine.hpp"
#include "crampon/geometry/placed.hpp"
#include "crampon/geometry/way_out.hpp"
#include "crampon/step/particle_view.hpp"

namespace crampon {

namespace {

/// What moves as one with a body: all bodies of its field and of those bonded to it, with their images in symmetry planes.
template <int Dim>
RegionPtr whole_of(const Problem& problem, const Model<Dim>& model, const std::vector<std::uint16_t>& joined, std::size_t body) {
  std::vector<RegionPtr> parts;
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) {
    if (joined[b] == joined[body] && problem.bodies[b].shape) parts.push_back(problem.bodies[b].shape);
  }
  if (parts.empty()) return nullptr;
  for (const SymmetryPlane& plane : model.symmetries) {
    const std::size_t count = parts.size();
    for (std::size_t p = 0; p < count; ++p)
      parts.push_back(std::make_shared<Mirrored>(parts[p], static_cast<std::size_t>(plane.axis), plane.at));
  }
  if (parts.size() == 1) return parts.front();
  return std::make_shared<Union>(std::move(parts));
}

/// Where the nearest point of a body's own surface is a joint or lies on a symmetry plane: the nearest surface of the whole along an axis.
template <int Dim>
Vec<Dim> nearest_free(const Region& whole, const Vec<Dim>& x, const Vec<Dim>& own, double reach, double slack) {
  Vec<3> from, end;
  for (std::size_t k = 0; k < Dim; ++k) from[k] = x[k], end[k] = x[k] + own[k] * (1 + slack / norm(own));
  if (whole.distance(end) > 0) return own;
  Vec<Dim> nearest;
  for (std::size_t k = 0; k < Dim; ++k) {
    for (const int sign : {-1, 1}) {
      Vec<3> n;
      n[static_cast<std::size_t>(k)] = sign;
      const auto way = way_out(whole, from, n, reach, slack);
      if (!way || (nearest != Vec<Dim>{} && *way >= norm(nearest))) continue;
      nearest = {};
      nearest[k] = sign * *way;
    }
  }
  return nearest;
}

/// Of particles that bear stress from the start, what takes their deformation back.
template <int Dim>
void keep_undeformed(const State<Dim>& state, Model<Dim>& model, std::size_t count) {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  const Particles<Dim>& particles = state.particles;
  model.undeformed.resize(count);
  for (const Run& run : state.order.runs) {
    for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
      Pack F[Dim * Dim];
      PackView<Dim>(state, model, run.material, k).deformation(F);
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t p = k * lanes + l;
        if (particles.is_padding(p)) continue;
        Matrix at_start;
        for (int i = 0; i < Dim; ++i) {
          for (int j = 0; j < Dim; ++j) at_start(i, j) = F[i * Dim + j][static_cast<int>(l)];
        }
        const Matrix back = at_start.inverse();
        for (int j = 0; j < Dim; ++j) {
          for (int i = 0; i < Dim; ++i)
            model.undeformed[particles.id[p]][static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = back(i, j);
        }
      }
    }
  }
}

}  // namespace

template <int Dim>
void keep_surfaces(const Problem& problem, const BuiltBodies<Dim>& bodies, const State<Dim>& state, Model<Dim>& model) {
  const bool any_stress = std::any_of(problem.bodies.begin(), problem.bodies.end(),
                                      [](const BodyInput& body) { return !std::holds_alternative<NoInitialStress>(body.initial_stress); });
  if (any_stress) keep_undeformed(state, model, bodies.particles.size());
  if (!model.any_rigid_face() && !(model.contact.several_fields() && outlines_tell(model.contact.material_detection, model.grid))) return;
  std::vector<std::uint16_t> joined(problem.bodies.size());
  for (const NewParticle<Dim>& p : bodies.particles) {
    if (p.body < joined.size()) joined[p.body] = model.contact.fields[model.materials[p.material].field].bonded_to;
  }
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) model.shapes.push_back(whole_of(problem, model, joined, b));
  const double cell = model.grid.smallest_cell();
  model.surface.reserve(bodies.particles.size());
  for (const NewParticle<Dim>& p : bodies.particles) {
    const bool knows = p.surface != Vec<Dim>{} && !std::isnan(p.surface[0]) && p.body < model.shapes.size();
    model.surface.push_back(knows ? nearest_free<Dim>(*model.shapes[p.body], p.x, p.surface,
                                                      depth_of_surface<Dim>(model.grid, bodies.per_cell[p.body]), 1e-9 * cell)
                                  : p.surface);
  }
}

template void keep_surfaces<2>(const Problem&, const BuiltBodies<2>&, const State<2>&, Model<2>&);
template void keep_surfaces<3>(const Problem&, const BuiltBodies<3>&, const State<3>&, Model<3>&);

}  // namespace crampon
