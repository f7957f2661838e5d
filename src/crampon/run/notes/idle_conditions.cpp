#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "crampon/run/build_bodies.hpp"
#include "crampon/run/notes/notes.hpp"
#include "crampon/step/fixed_components.hpp"

namespace crampon {

namespace {

/// Nodes from low to high along each axis.
template <int Dim>
struct NodeBox {
  IndexVector<Dim> low{}, high{};

  bool meets(const NodeBox& other) const {
    for (int k = 0; k < Dim; ++k) {
      if (low[k] > other.high[k] || other.low[k] > high[k]) return false;
    }
    return true;
  }
  /// Does f(node) hold for one of them?
  template <class F>
  bool any(F f) const {
    IndexVector<Dim> node = low;
    for (;;) {
      if (f(node)) return true;
      int k = 0;
      while (k < Dim && ++node[k] > high[k]) node[k] = low[k], ++k;
      if (k == Dim) return false;
    }
  }
};

/// The nodes that feel a particle.
template <int Dim>
NodeBox<Dim> nodes_about(const Start<Dim>& start, const typename BodySpace<Dim>::Particle& particle) {
  const Grid<Dim>& grid = start.model.grid;
  NodeBox<Dim> box;
  for (int k = 0; k < Dim; ++k) {
    const double at = (particle.x[k] - grid.origin[k]) * grid.inverse_cell[k];
    const double reach =
        boxes_of(start.model.shape_functions).reach(particle.half[k] * grid.inverse_cell[k]) - 1e-9;  // no weight at its end
    box.low[k] = static_cast<int>(std::ceil(at - reach));
    box.high[k] = static_cast<int>(std::floor(at + reach));
  }
  return box;
}

/// Nodes that a condition holds.
template <int Dim>
struct HeldNodes {
  std::vector<std::int64_t> numbers;  ///< Grid::node_number, ascending
  NodeBox<Dim> box;                   ///< about them
};

template <int Dim>
HeldNodes<Dim> held_by(const VelocityCondition<Dim>& condition, const Grid<Dim>& grid) {
  HeldNodes<Dim> held{condition.nodes, {}};
  held.box.low.fill(std::numeric_limits<int>::max());
  held.box.high.fill(std::numeric_limits<int>::min());
  for (const std::int64_t number : held.numbers) {
    const IndexVector<Dim> node = grid.node_coordinates(number);
    for (int k = 0; k < Dim; ++k) {
      held.box.low[k] = std::min(held.box.low[k], node[k]);
      held.box.high[k] = std::max(held.box.high[k], node[k]);
    }
  }
  return held;
}

/// The same of a rigid boundary, at the start.
template <int Dim>
HeldNodes<Dim> held_by(const BodySpace<Dim>& rigid, const Start<Dim>& start) {
  VelocityCondition<Dim> at_start;
  for (const auto& p : rigid.particles()) {
    nodes_about(start, p).any([&](const IndexVector<Dim>& node) {
      if (rigid.distance(start.model.grid.node_position(node)) > prescribing_reach(start.model.grid)) return false;
      at_start.nodes.push_back(start.model.grid.node_number(node));
      return false;
    });
  }
  std::sort(at_start.nodes.begin(), at_start.nodes.end());
  at_start.nodes.erase(std::unique(at_start.nodes.begin(), at_start.nodes.end()), at_start.nodes.end());
  return held_by(at_start, start.model.grid);
}

template <int Dim>
bool any_body_at(const Start<Dim>& start, const HeldNodes<Dim>& held) {
  for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
    for (const auto& p : start.bodies[b].particles()) {
      const NodeBox<Dim> about = nodes_about(start, p);
      if (about.meets(held.box) && about.any([&](const IndexVector<Dim>& node) {
            return std::binary_search(held.numbers.begin(), held.numbers.end(), start.model.grid.node_number(node));
          }))
        return true;
    }
  }
  return false;
}

/// The body of the particle for which distance(x) is smallest, and that distance.
template <int Dim, class Distance>
std::string nearest_body(const Start<Dim>& start, Distance distance) {
  double nearest = std::numeric_limits<double>::infinity();
  std::string name;
  for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
    for (const auto& p : start.bodies[b].particles()) {
      const double d = distance(p.x);
      if (d < nearest) nearest = d, name = start.bodies[b].name();
    }
  }
  return fmt::format("the nearest particle, of \"{}\", is {:.3g} m away", name, nearest);
}

}  // namespace

template <int Dim>
void note_idle_conditions(const Start<Dim>& start, Notes& notes) {
  const Problem& problem = start.problem;
  const auto& conditions = start.model.conditions;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const bool by_rigid = conditions[c].rigid_body >= 0;
    const BodySpace<Dim>* rigid =
        by_rigid ? &start.bodies[problem.bodies.size() + static_cast<std::size_t>(conditions[c].rigid_body)] : nullptr;
    if (any_body_at(start, by_rigid ? held_by(*rigid, start) : held_by(conditions[c], start.model.grid))) continue;
    const char* remedy = "move it to a body, unless one is to come there";
    if (by_rigid) {
      notes.push_back({rigid->stated().location, fmt::format("no body is at the rigid boundary \"{}\"", conditions[c].name),
                       nearest_body(start, [&](const Vec<Dim>& x) { return rigid->distance(x); }), remedy});
    } else if (c < problem.boundaries.size()) {
      const BoundaryInput& in = problem.boundaries[c];
      notes.push_back({in.at("region"), fmt::format("no body is at the nodes of \"{}\"", in.name),
                       nearest_body(start, [&](const Vec<Dim>& x) { return in.region->distance(in_space(x)); }), remedy});
    } else {
      const SymmetryInput& in = problem.symmetries[c - problem.boundaries.size()];
      const auto axis = static_cast<std::size_t>(in.axis);
      notes.push_back({in.Located::at("at"), fmt::format("no body is at the symmetry plane \"{}\"", in.name),
                       nearest_body(start, [&](const Vec<Dim>& x) { return std::fabs(x[axis] - in.at); }), remedy});
    }
  }
}

template void note_idle_conditions(const Start<2>&, Notes&);
template void note_idle_conditions(const Start<3>&, Notes&);

}  // namespace crampon
