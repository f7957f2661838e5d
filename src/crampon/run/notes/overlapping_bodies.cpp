#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

namespace {

/// Particles of one body within another.
struct Inside {
  double count = 0, measure = 0;
  bool sampled = false;  ///< found from some of many particles
};

template <int Dim>
bool boxes_meet(const BodySpace<Dim>& a, const BodySpace<Dim>& b) {
  for (int k = 0; k < Dim; ++k) {
    if (a.low()[k] >= b.high()[k] || b.low()[k] >= a.high()[k]) return false;
  }
  return !a.particles().empty() && !b.particles().empty();
}

template <int Dim>
Inside particles_within(const BodySpace<Dim>& a, const BodySpace<Dim>& b, double slack) {
  using Particle = typename BodySpace<Dim>::Particle;
  std::vector<const Particle*> near;
  for (const Particle& p : a.particles()) {
    bool in_box = true;
    for (int k = 0; k < Dim; ++k) in_box = in_box && p.x[k] >= b.low()[k] && p.x[k] <= b.high()[k];
    if (in_box) near.push_back(&p);
  }
  // Distances to shapes of many edges are dear: a part of very many particles tells as much.
  constexpr std::size_t enough = 200000;
  const std::size_t stride = near.size() / enough + 1;
  Inside inside;
  inside.sampled = stride > 1;
  for (std::size_t i = 0; i < near.size(); i += stride) {
    const bool in = slack >= 0 ? b.contains(near[i]->x, slack) : b.distance(near[i]->x) < slack;
    if (in) inside.count += static_cast<double>(stride), inside.measure += static_cast<double>(stride) * near[i]->measure;
  }
  return inside;
}

}  // namespace

template <int Dim>
void note_overlapping_bodies(const Start<Dim>& start, Notes& notes) {
  const double h = start.model.grid.smallest_cell();
  for (std::size_t b = 1; b < start.bodies.size(); ++b) {
    const bool rigid = is_rigid_body(start.problem, b);
    // A rigid boundary holds the nodes of the body in which it lies.
    if (rigid && start.problem.rigids[b - start.problem.bodies.size()].role == RigidInput::Role::boundary) continue;
    for (std::size_t a = 0; a < std::min(b, start.problem.bodies.size()); ++a) {
      const BodySpace<Dim>&first = start.bodies[a], &second = start.bodies[b];
      if (!boxes_meet(first, second)) continue;
      const std::uint16_t f = first.field(), g = second.field();
      if (f != g && start.model.contact.law_between(f, g).ignores()) continue;  // they pass through each other
      // An edge that bodies share puts particles of both on it; a tool may touch a particle.
      const double slack = rigid ? -1e-6 * h : 1e-9 * h;
      const BodySpace<Dim>* of = &first;
      const BodySpace<Dim>* in = &second;
      Inside inside = particles_within(*of, *in, slack);
      if (inside.count == 0 && !rigid) {
        std::swap(of, in);
        inside = particles_within(*of, *in, slack);
      }
      if (inside.count == 0) continue;
      notes.push_back(
          {second.stated().at(second.shape() ? "shape" : "particles"),
           fmt::format("the bodies \"{}\" and \"{}\" overlap: {}{} of the {} particles of \"{}\" ({}, {:.2g} % of it) lie in \"{}\"",
                       first.name(), second.name(), inside.sampled ? "about " : "", inside.count, of->particles().size(), of->name(),
                       measure_text<Dim>(inside.measure), 100 * inside.measure / of->measure(), in->name()),
           rigid ? "contact acts at the surface of a body, and material inside a rigid one does not feel it"
                 : "the material there counts twice",
           rigid ? "move one of them, or cut the hole that the rigid one fills (kind = \"difference\")"
                 : "move one of them, or cut it out of the other (kind = \"difference\")"});
    }
  }
}

template void note_overlapping_bodies(const Start<2>&, Notes&);
template void note_overlapping_bodies(const Start<3>&, Notes&);

}  // namespace crampon
