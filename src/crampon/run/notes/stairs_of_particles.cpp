#include <cmath>

#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

namespace {

constexpr double worth_a_word = 0.01;  // of the measure: forces on the body's faces are off by as much

template <int Dim>
bool lies_in(const Region& shape, const Grid<Dim>& grid) {
  const Bounds3 box = shape.bounds();
  Vec<Dim> low, high;
  for (std::size_t k = 0; k < Dim; ++k) low[k] = box.low[k], high[k] = box.high[k];
  return grid.contains(low) && grid.contains(high);
}

}  // namespace

template <int Dim>
void note_stairs_of_particles(const Start<Dim>& start, Notes& notes) {
  for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
    const BodyInput& in = start.problem.bodies[b];
    if (!in.shape || in.match_mass || in.shape->dimension() != Dim || !in.shape->measure() || !lies_in(*in.shape, start.model.grid))
      continue;
    double filled = 0;
    for (const auto& p : start.bodies[b].particles()) filled += p.measure;
    const double wanted = *in.shape->measure(), more = filled / wanted - 1;
    if (std::fabs(more) < worth_a_word) continue;
    notes.push_back({in.at("shape"),
                     fmt::format("the particles of \"{}\" have {:.1f} % {} {} than its shape", in.name, 100 * std::fabs(more),
                                 more > 0 ? "more" : "less", Dim == 2 ? "area" : "volume"),
                     "each stands for a whole sub-cell, and those with their middle in the shape make a staircase",
                     "set match_mass = true, or false to keep them without this note"});
  }
}

template void note_stairs_of_particles(const Start<2>&, Notes&);
template void note_stairs_of_particles(const Start<3>&, Notes&);

}  // namespace crampon
