#include <algorithm>

#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

template <int Dim>
void note_large_particles(const Start<Dim>& start, Notes& notes) {
  double cell = 1;
  for (int k = 0; k < Dim; ++k) cell *= start.model.grid.cell[k];
  for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
    const BodySpace<Dim>& body = start.bodies[b];
    std::size_t large = 0;
    double largest = 0;
    for (const auto& p : body.particles()) {
      large += p.measure > cell * (1 + 1e-6);  // the round-off of decimals in a file
      largest = std::max(largest, p.measure);
    }
    if (large == 0) continue;
    notes.push_back({body.stated().at(body.shape() ? "particles_per_cell" : "particles"),
                     fmt::format("{} of the {} particles of \"{}\" are larger than a cell: up to {}, and a cell has {}", large,
                                 body.particles().size(), body.name(), measure_text<Dim>(largest), measure_text<Dim>(cell)),
                     "nodes between such particles see none of them, and the body falls apart",
                     Dim == 2 ? "use larger cells or more particles; volumes in the file are areas times the thickness of the body"
                              : "use larger cells or more particles"});
  }
}

template void note_large_particles(const Start<2>&, Notes&);
template void note_large_particles(const Start<3>&, Notes&);

}  // namespace crampon
