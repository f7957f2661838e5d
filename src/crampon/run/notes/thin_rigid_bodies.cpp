#include <cmath>

#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

namespace {

/// Diameter of the largest ball in the body, m: from the deepest of its particles, and points about that.
template <int Dim>
double thickness_of(const BodySpace<Dim>& body) {
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

}  // namespace

template <int Dim>
void note_thin_rigid_bodies(const Start<Dim>& start, Notes& notes) {
  const double h = start.model.grid.smallest_cell();
  for (std::size_t r = 0; r < start.problem.rigids.size(); ++r) {
    const RigidInput& in = start.problem.rigids[r];
    // A rigid boundary holds the nodes that it reaches, however thin it is.
    if (in.role == RigidInput::Role::boundary) continue;
    // One that is known by a formula meets bodies at its faces, whatever nodes are beside it.
    if (start.model.rigid_bodies[r].wall) continue;
    const BodySpace<Dim>& body = start.bodies[start.problem.bodies.size() + r];
    const double thickness = thickness_of(body);
    if (thickness > h * (1 - 1e-6)) continue;
    notes.push_back({in.at("shape"),
                     fmt::format("the rigid body \"{}\" is {:.3g} m thick, which is {:.2g} of a cell", in.name, thickness, thickness / h),
                     "a node beside it sees bodies on both of its sides at once, and they stick to each other through it",
                     fmt::format("make it thicker, or cells smaller than {:.3g} m", thickness)});
  }
}

template void note_thin_rigid_bodies(const Start<2>&, Notes&);
template void note_thin_rigid_bodies(const Start<3>&, Notes&);

}  // namespace crampon
