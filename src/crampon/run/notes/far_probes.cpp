#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

template <int Dim>
void note_far_probes(const Start<Dim>& start, Notes& notes) {
  const double slack = 1e-6 * start.model.grid.smallest_cell();  // of decimals: a point on an edge is in the body
  for (const ProbeInput& probe : start.problem.probes) {
    Vec<Dim> x;
    for (std::size_t k = 0; k < Dim; ++k) x[k] = probe.point[k];
    const BodySpace<Dim>* nearest = nullptr;
    double distance = std::numeric_limits<double>::infinity();
    for (const BodySpace<Dim>& body : start.bodies) {
      if (!probe.body.empty() && body.name() != probe.body) continue;
      const double d = body.distance(x);
      if (d < distance) distance = d, nearest = &body;
    }
    if (nearest == nullptr || distance <= slack) continue;
    notes.push_back({probe.at("point"),
                     fmt::format("the probe \"{}\" is outside {}, {:.3g} m from \"{}\"", probe.name,
                                 probe.body.empty() ? "every body" : "its body", distance, nearest->name()),
                     "it watches the nearest particle", "move the point into the body"});
  }
}

template void note_far_probes(const Start<2>&, Notes&);
template void note_far_probes(const Start<3>&, Notes&);

}  // namespace crampon
