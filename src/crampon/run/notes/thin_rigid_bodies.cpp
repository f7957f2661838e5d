#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"
#include "crampon/step/rigid_faces.hpp"

namespace crampon {

namespace {

/// Diameter of the largest ball in the body, m: from the deepest of its particles, and points about that.
template <int Dim>
double thickness_of(const BodySpace<Dim>& body) {
  if (body.particles().empty()) return 0;  // between the places of particles
  const auto* deepest = &body.particles().front();
  double depth = 0;
  for (const auto& p : body.particles()) {
    const double d = -body.distance(p.x);
    if (d > depth) depth = d, deepest = &p;
  }
  constexpr int side = 9;
  for (int n = 0; n < power(side, Dim); ++n) {
    const IndexVector<Dim> at = unflatten<Dim>(n, side);
    Vec<Dim> x = deepest->x;
    for (int k = 0; k < Dim; ++k) x[k] += (at[k] * 2. / (side - 1) - 1) * deepest->half[k];
    depth = std::fmax(depth, -body.distance(x));
  }
  return 2 * depth;
}

/// A velocity field of which material lies before opposite sides of a rigid body, nearer than two cells; -1: none.
template <int Dim>
int field_on_both_sides(const Start<Dim>& start, std::size_t r) {
  const Model<Dim>& model = start.model;
  const double near = 2 * model.grid.smallest_cell();
  std::vector<std::vector<Vec<Dim>>> sides(model.contact.fields.size());
  for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
    const BodySpace<Dim>& body = start.bodies[b];
    for (const auto& p : body.particles()) {
      const RigidFaceView<Dim> view = see_face(model.rigid_bodies[r], start.state.rigid[r].start, p.x);
      if (view.distance > near || view.out == Vec<Dim>{}) continue;
      std::vector<Vec<Dim>>& known = sides[body.field()];
      if (std::any_of(known.begin(), known.end(), [&](const Vec<Dim>& out) { return dot(out, view.out) < -0.9; })) return body.field();
      if (std::none_of(known.begin(), known.end(), [&](const Vec<Dim>& out) { return dot(out, view.out) > 0.9; }))
        known.push_back(view.out);
    }
  }
  return -1;
}

}  // namespace

template <int Dim>
void note_thin_rigid_bodies(const Start<Dim>& start, Notes& notes) {
  using Acts = typename RigidBody<Dim>::Acts;
  const double h = start.model.grid.smallest_cell();
  for (std::size_t r = 0; r < start.problem.rigids.size(); ++r) {
    const RigidInput& in = start.problem.rigids[r];
    const Acts acts = start.model.rigid_bodies[r].acts;
    if (acts == Acts::nodes) continue;  // it holds the nodes that it reaches, however thin it is
    const double thickness = thickness_of(start.bodies[start.problem.bodies.size() + r]);
    if (thickness > h * (1 - 1e-6)) continue;
    // At its faces it meets bodies however thin it is, unless one field has material on both of its sides.
    const int field = acts == Acts::face ? field_on_both_sides(start, r) : -1;
    if (acts == Acts::face && field < 0) continue;
    const std::string thin =
        fmt::format("the rigid body \"{}\" is {:.3g} m thick, which is {:.2g} of a cell", in.name, thickness, thickness / h);
    if (acts == Acts::particles) {
      notes.push_back({in.at("shape"), thin,
                       "a node beside it sees bodies on both of its sides at once, and they stick to each other through it",
                       fmt::format("leave out faces = \"particles\", make it thicker, or cells smaller than {:.3g} m", thickness)});
    } else {
      notes.push_back({in.at("shape"), thin + ", and one velocity field has material on both of its sides",
                       "a node beside it sees both at once, and they stick to each other through it",
                       "set contact.fields = \"bodies\", or give one of the bodies a field of its own"});
    }
  }
}

template void note_thin_rigid_bodies(const Start<2>&, Notes&);
template void note_thin_rigid_bodies(const Start<3>&, Notes&);

}  // namespace crampon
