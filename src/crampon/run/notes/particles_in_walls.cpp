#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"
#include "crampon/step/rigid_faces.hpp"

namespace crampon {

template <int Dim>
void note_particles_in_walls(const Start<Dim>& start, Notes& notes) {
  const Model<Dim>& model = start.model;
  for (std::size_t w = 0; w < start.problem.walls.size(); ++w) {
    const std::size_t r = start.problem.rigids.size() + w;
    const RigidBody<Dim>& wall = model.rigid_bodies[r];
    std::size_t inside = 0;
    for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
      const BodySpace<Dim>& body = start.bodies[b];
      if (model.contact.law_between(body.field(), wall.field).ignores()) continue;
      for (const auto& p : body.particles()) inside += distance_from(wall, start.state.rigid[r].start, p.x) < -model.grid.smallest_cell();
    }
    if (inside == 0) continue;
    notes.push_back({start.problem.walls[w].location,
                     fmt::format("{} particles begin more than a cell inside the wall \"{}\"", inside, wall.name),
                     "it lets their nodes move outwards only", "move the wall or the body"});
  }
}

template void note_particles_in_walls(const Start<2>&, Notes&);
template void note_particles_in_walls(const Start<3>&, Notes&);

}  // namespace crampon
