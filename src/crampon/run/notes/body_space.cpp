#include "crampon/run/notes/body_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/run/build_bodies.hpp"

namespace crampon {

template <int Dim>
std::int64_t BodySpace<Dim>::cell_of(const Vec<Dim>& x, const IndexVector<Dim>& shift) const {
  IndexVector<Dim> cell{};
  for (int k = 0; k < Dim; ++k) cell[k] = static_cast<int>(std::floor((x[k] - grid_->origin[k]) * grid_->inverse_cell[k])) + shift[k];
  return grid_->node_number(cell);
}

template <int Dim>
void BodySpace<Dim>::add(std::uint32_t slot, const Vec<Dim>& x, const Vec<Dim>& half, double measure) {
  if (particles_.empty()) low_ = x - half, high_ = x + half;
  for (int k = 0; k < Dim; ++k) {
    low_[k] = std::fmin(low_[k], x[k] - half[k]);
    high_[k] = std::fmax(high_[k], x[k] + half[k]);
  }
  if (!shape_) by_cell_[cell_of(x, {})].push_back(static_cast<std::uint32_t>(particles_.size()));
  particles_.push_back({slot, x, half, measure});
  measure_ += measure;
}

namespace {
/// From x to the box, m; 0 inside.
template <int Dim>
double distance_to_box(const Vec<Dim>& x, const Vec<Dim>& centre, const Vec<Dim>& half) {
  Vec<Dim> beyond;
  for (int k = 0; k < Dim; ++k) beyond[k] = std::fmax(0., std::fabs(x[k] - centre[k]) - half[k]);
  return norm(beyond);
}
}  // namespace

template <int Dim>
bool BodySpace<Dim>::contains(const Vec<Dim>& x, double slack) const {
  if (shape_) return shape_->contains(in_space(x), slack);
  for (int n = 0; n < neighbour_count<Dim>; ++n) {  // no box is larger than a cell
    IndexVector<Dim> shift = unflatten<Dim>(n, 3);
    for (int k = 0; k < Dim; ++k) shift[k] -= 1;
    const auto found = by_cell_.find(cell_of(x, shift));
    if (found == by_cell_.end()) continue;
    for (const std::uint32_t p : found->second) {
      if (distance_to_box(x, particles_[p].x, particles_[p].half) <= slack) return true;
    }
  }
  return false;
}

template <int Dim>
double BodySpace<Dim>::distance(const Vec<Dim>& x) const {
  if (shape_) return shape_->distance(in_space(x));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Particle& p : particles_) nearest = std::fmin(nearest, distance_to_box(x, p.x, p.half));
  return nearest;
}

template <int Dim>
std::vector<BodySpace<Dim>> find_body_spaces(const Problem& problem, const Model<Dim>& model, const State<Dim>& state) {
  std::vector<BodySpace<Dim>> spaces;
  for (const BodyInput& in : problem.bodies) spaces.emplace_back(in.name, in, in.shape, model.grid);
  for (const RigidInput& in : problem.rigids) spaces.emplace_back(in.name, in, in.shape, model.grid);
  for (const Run& run : state.order.runs) {
    const Material<Dim>& material = model.materials[run.material];
    Vec<Dim> half;
    double box = 1;
    for (int k = 0; k < Dim; ++k) {
      half[k] = material.half_size[k] * model.grid.cell[k];
      box *= 2 * half[k];
    }
    for (std::size_t p = std::size_t{run.first_pack} * lanes; p < std::size_t{run.end_pack} * lanes; ++p) {
      if (state.particles.is_padding(p)) continue;
      BodySpace<Dim>& space = spaces[state.particles.body[p]];
      space.set_field(material.field);
      const double measure = state.particles.volume(p) / material.thickness;
      // A file may hold particles that are smaller than particles_per_cell says: their boxes must not reach into each other.
      const double scale = space.shape() ? 1. : std::fmin(1., std::pow(measure / box, 1. / Dim));
      space.add(static_cast<std::uint32_t>(p), state.particles.position(p), half * scale, measure);
    }
  }
  return spaces;
}

template class BodySpace<2>;
template class BodySpace<3>;
template std::vector<BodySpace<2>> find_body_spaces<2>(const Problem&, const Model<2>&, const State<2>&);
template std::vector<BodySpace<3>> find_body_spaces<3>(const Problem&, const Model<3>&, const State<3>&);

}  // namespace crampon
