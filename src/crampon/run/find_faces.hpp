#pragma once
/// The outer faces of a filled body: sides of the sub-cells of its particles that no particle of the body lies beside.

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "crampon/run/build_bodies.hpp"

namespace crampon {

/// Which sub-cell of the lattice holds which particle of a body.
template <int Dim>
class BodyLattice {
 public:
  using Index = IndexVector<Dim>;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  BodyLattice(const BuiltBodies<Dim>& bodies, const Grid<Dim>& grid, std::size_t body);

  Index index_of(const Vec<Dim>& x) const;
  /// The middle of a sub-cell, m.
  Vec<Dim> centre(const Index& i) const;
  /// Id of the particle there, or none.
  std::uint32_t at(const Index& i) const;
  double size(int axis) const { return sub_[axis]; }  ///< of a sub-cell, m
  /// Does the body have nothing from here on, this sub-cell included?
  bool is_open(Index i, int axis, int direction) const;
  const std::vector<std::uint32_t>& particles() const { return particles_; }

 private:
  Vec<Dim> origin_, sub_;
  Index low_{}, count_{};
  std::vector<std::uint32_t> id_;  ///< [sub-cell of the body's box]
  std::vector<std::uint32_t> particles_;
};

/// An outer face, and the point of the shape's boundary that it stands for.
template <int Dim>
struct OuterFace {
  std::uint32_t particle = 0;
  int axis = 0, direction = 1;  ///< of the face's outward normal
  Vec<Dim> point, normal;       ///< on the boundary of the shape: where the way out of the particle through the face meets it
};

/// All outer faces of a body in the order of its particles, but for those on symmetry planes, where it goes on.
template <int Dim>
std::vector<OuterFace<Dim>> find_outer_faces(const BodyLattice<Dim>& lattice, const BuiltBodies<Dim>& bodies, const Region& shape,
                                             const std::vector<SymmetryPlane>& symmetries);

/// Is the middle of a face on a symmetry plane?
template <int Dim>
const SymmetryPlane* plane_of_face(const std::vector<SymmetryPlane>& symmetries, Vec<Dim> x, int axis, double slack);

}  // namespace crampon
