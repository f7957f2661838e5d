#include "crampon/run/find_faces.hpp"

#include <algorithm>

namespace crampon {

template <int Dim>
BodyLattice<Dim>::BodyLattice(const BuiltBodies<Dim>& bodies, const Grid<Dim>& grid, std::size_t body) : origin_(grid.origin) {
  for (int k = 0; k < Dim; ++k) sub_[k] = grid.cell[k] / bodies.per_cell[body][k];
  Index high{};
  for (std::size_t p = 0; p < bodies.particles.size(); ++p) {
    if (bodies.particles[p].body != body) continue;
    const Index i = index_of(bodies.particles[p].x);
    for (int k = 0; k < Dim; ++k) {
      low_[k] = particles_.empty() ? i[k] : std::min(low_[k], i[k]);
      high[k] = particles_.empty() ? i[k] : std::max(high[k], i[k]);
    }
    particles_.push_back(static_cast<std::uint32_t>(p));
  }
  std::size_t total = 1;
  for (int k = 0; k < Dim; ++k) {
    count_[k] = high[k] - low_[k] + 1;
    total *= static_cast<std::size_t>(count_[k]);
  }
  id_.assign(total, none);
  for (const std::uint32_t p : particles_) {
    const Index i = index_of(bodies.particles[p].x);
    std::size_t at = 0;
    for (int k = Dim - 1; k >= 0; --k) at = at * static_cast<std::size_t>(count_[k]) + static_cast<std::size_t>(i[k] - low_[k]);
    id_[at] = p;
  }
}

template <int Dim>
IndexVector<Dim> BodyLattice<Dim>::index_of(const Vec<Dim>& x) const {
  Index i{};
  for (int k = 0; k < Dim; ++k) i[k] = static_cast<int>(std::floor((x[k] - origin_[k]) / sub_[k]));
  return i;
}

template <int Dim>
Vec<Dim> BodyLattice<Dim>::centre(const Index& i) const {
  Vec<Dim> x;
  for (int k = 0; k < Dim; ++k) x[k] = origin_[k] + (i[k] + 0.5) * sub_[k];
  return x;
}

template <int Dim>
std::uint32_t BodyLattice<Dim>::at(const Index& i) const {
  std::size_t at = 0;
  for (int k = Dim - 1; k >= 0; --k) {
    if (i[k] < low_[k] || i[k] >= low_[k] + count_[k]) return none;
    at = at * static_cast<std::size_t>(count_[k]) + static_cast<std::size_t>(i[k] - low_[k]);
  }
  return id_[at];
}

template <int Dim>
bool BodyLattice<Dim>::is_open(Index i, int axis, int direction) const {
  for (; i[axis] >= low_[axis] && i[axis] < low_[axis] + count_[axis]; i[axis] += direction) {
    if (at(i) != none) return false;
  }
  return true;
}

template <int Dim>
const SymmetryPlane* plane_of_face(const std::vector<SymmetryPlane>& symmetries, Vec<Dim> x, int axis, double slack) {
  for (const SymmetryPlane& plane : symmetries) {
    if (plane.axis != axis || std::fabs(x[axis] - plane.at) > slack) continue;
    x[axis] = plane.at;
    if (on_plane<Dim>(plane, x)) return &plane;
  }
  return nullptr;
}

namespace {

/// Where the boundary lies between a point in the shape and one `step` further on that is not.
template <int Dim>
Vec<Dim> boundary_between(const Region& shape, const Vec<Dim>& inside, const Vec<Dim>& step) {
  double in = 0, out = 1;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (in + out);
    (shape.distance(in_space(inside + step * middle)) <= 0 ? in : out) = middle;
  }
  return inside + step * in;
}

/// Gradient of the distance by differences much smaller than particles.
template <int Dim>
Vec<Dim> normal_at(const Region& shape, const Vec<Dim>& x, double step) {
  Vec<Dim> n;
  for (int k = 0; k < Dim; ++k) {
    Vec<Dim> a = x, b = x;
    a[k] -= step;
    b[k] += step;
    n[k] = shape.distance(in_space(b)) - shape.distance(in_space(a));
  }
  return normalized(n);
}

}  // namespace

template <int Dim>
std::vector<OuterFace<Dim>> find_outer_faces(const BodyLattice<Dim>& lattice, const BuiltBodies<Dim>& bodies, const Region& shape,
                                             const std::vector<SymmetryPlane>& symmetries) {
  std::vector<OuterFace<Dim>> faces;
  for (const std::uint32_t p : lattice.particles()) {
    const Vec<Dim>& x = bodies.particles[p].x;
    const IndexVector<Dim> own = lattice.index_of(x);
    const Vec<Dim> centre = lattice.centre(own);
    for (int axis = 0; axis < Dim; ++axis) {
      for (const int direction : {-1, 1}) {
        IndexVector<Dim> beside = own;
        beside[axis] += direction;
        if (lattice.at(beside) != BodyLattice<Dim>::none) continue;
        Vec<Dim> step;
        step[axis] = direction * lattice.size(axis);
        if (plane_of_face(symmetries, centre + step * 0.5, axis, 1e-6 * lattice.size(axis))) continue;
        OuterFace<Dim> face{p, axis, direction, centre + step * 0.5, step * (1 / lattice.size(axis))};
        if (shape.distance(in_space(x + step)) > 0) {  // else the grid ends here, and the body with it
          face.point = boundary_between(shape, x, step);
          const Vec<Dim> normal = normal_at(shape, face.point, 1e-4 * lattice.size(axis));
          if (norm(normal) > 0) face.normal = normal;
        }
        faces.push_back(face);
      }
    }
  }
  return faces;
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                              \
  template class BodyLattice<DIM>;                                                                                            \
  template const SymmetryPlane* plane_of_face<DIM>(const std::vector<SymmetryPlane>&, Vec<DIM>, int, double);                 \
  template std::vector<OuterFace<DIM>> find_outer_faces<DIM>(const BodyLattice<DIM>&, const BuiltBodies<DIM>&, const Region&, \
                                                             const std::vector<SymmetryPlane>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
