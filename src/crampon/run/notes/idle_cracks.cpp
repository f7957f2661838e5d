#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "crampon/crack/crossing.hpp"
#include "crampon/run/notes/notes.hpp"

namespace crampon {

namespace {

/// Is there something at x that cracks part? Beyond a symmetry plane there is what its mirror image is in.
bool is_cut_material(const Start<2>& start, Vec<2> x) {
  for (const SymmetryPlane& plane : start.model.symmetries) {
    const auto axis = static_cast<std::size_t>(plane.axis);
    if ((x[axis] - plane.at) * plane.side < 0) x[axis] = 2 * plane.at - x[axis];
  }
  for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
    const BodySpace<2>& body = start.bodies[b];
    if (!start.model.ignores_cracks(body.field()) && body.contains(x, 1e-9 * start.model.grid.smallest_cell())) return true;
  }
  return false;
}

/// Edge of the smallest particle, m.
double smallest_particle(const Start<2>& start) {
  double size = std::numeric_limits<double>::infinity();
  for (const Material<2>& material : start.model.materials) {
    for (std::size_t k = 0; k < 2; ++k) size = std::fmin(size, 2 * material.half_size[k] * start.model.grid.cell[k]);
  }
  return size;
}

/// Is there material on both sides somewhere, half a particle away as its particles are at the least?
bool lies_in_material(const Start<2>& start, const Crack<2>& crack, double away) {
  for (std::size_t s = 0; s + 1 < crack.plane.size(); ++s) {
    const Vec<2>&a = crack.plane[s], &b = crack.plane[s + 1];
    const Vec<2> aside = away * segment_normal(a, b);
    for (const double along : {0.25, 0.75}) {
      const Vec<2> x = a + along * (b - a);
      if (is_cut_material(start, x + aside) && is_cut_material(start, x - aside)) return true;
    }
  }
  return false;
}

/// Does the line from some particle to a node about it cross the crack? For short cracks.
bool parts_some_pair(const Start<2>& start, const Crack<2>& crack) {
  const Grid<2>& grid = start.model.grid;
  Vec<2> low = crack.plane.front(), high = low;
  for (const Vec<2>& v : crack.plane) {
    for (std::size_t k = 0; k < 2; ++k) low[k] = std::fmin(low[k], v[k]), high[k] = std::fmax(high[k], v[k]);
  }
  const std::vector<FacetNeighbours<2>> neighbours = find_neighbours<2>(crack.facets, crack.plane.size(), crack.closed);
  const CrackMesh<2> mesh{crack.plane, crack.facets, neighbours};
  const int reach = with_shape(start.model.shape_functions, []<class Shape>(std::type_identity<Shape>) { return cells_beyond<Shape> + 1; });
  for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
    if (start.model.ignores_cracks(start.bodies[b].field())) continue;
    for (const auto& p : start.bodies[b].particles()) {
      IndexVector<2> cell{};
      bool near = true;
      for (std::size_t k = 0; k < 2; ++k) {
        near = near && p.x[k] > low[k] - reach * grid.cell[k] && p.x[k] < high[k] + reach * grid.cell[k];
        cell[k] = static_cast<int>(std::floor((p.x[k] - grid.origin[k]) * grid.inverse_cell[k]));
      }
      if (!near) continue;
      for (int j = 1 - reach; j <= reach; ++j) {
        for (int i = 1 - reach; i <= reach; ++i) {
          if (cross_crack(mesh, p.x, grid.node_position({cell[0] + i, cell[1] + j})).crosses()) return true;
        }
      }
    }
  }
  return false;
}

double length_of(const Crack<2>& crack) {
  double length = 0;
  for (std::size_t s = 0; s + 1 < crack.plane.size(); ++s) length += norm(crack.plane[s + 1] - crack.plane[s]);
  return length;
}

/// The nearest body that cracks part, and how far it is.
std::string nearest_body(const Start<2>& start, const Crack<2>& crack) {
  double nearest = std::numeric_limits<double>::infinity();
  std::string name;
  for (std::size_t b = 0; b < start.problem.bodies.size(); ++b) {
    if (start.model.ignores_cracks(start.bodies[b].field())) continue;
    for (const Vec<2>& v : crack.plane) {
      const double d = start.bodies[b].distance(v);
      if (d < nearest) nearest = d, name = start.bodies[b].name();
    }
  }
  if (name.empty()) return "no body is parted by cracks";
  if (nearest <= 1e-6 * start.model.grid.smallest_cell()) return fmt::format("nowhere is there a particle of \"{}\" on either side", name);
  return fmt::format("the nearest body, \"{}\", is {:.3g} m away", name, nearest);
}

}  // namespace

template <int Dim>
void note_idle_cracks(const Start<Dim>& start, Notes& notes) {
  if constexpr (Dim == 2) {  // cracks are lines in the plane
    const double h = start.model.grid.smallest_cell(), away = 0.5 * smallest_particle(start);
    for (std::size_t c = 0; c < start.problem.cracks.size(); ++c) {
      const CrackInput& in = start.problem.cracks[c];
      const Crack<2>& crack = start.state.cracks.list[c];
      const Location& place = in.at(in.arc ? "arc" : "points");
      if (!lies_in_material(start, crack, away)) {
        notes.push_back({place, fmt::format("the crack \"{}\" cuts nothing", in.name), nearest_body(start, crack),
                         "move it, or let it pass between particles of the body"});
      } else if (length_of(crack) < 2 * h && !parts_some_pair(start, crack)) {
        notes.push_back({place, fmt::format("the crack \"{}\" cuts nothing", in.name),
                         fmt::format("it is {:.2g} cells long, and no line from a particle to a node crosses it", length_of(crack) / h),
                         "use smaller cells or a longer crack"});
      }
    }
  }
}

template void note_idle_cracks(const Start<2>&, Notes&);
template void note_idle_cracks(const Start<3>&, Notes&);

}  // namespace crampon
