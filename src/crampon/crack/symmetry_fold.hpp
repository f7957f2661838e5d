#pragma once
/// Symmetry planes, possibly only part of a plane, folded per pair of particle and node (conventions 29).
///
/// A model of one half with the plane x >= a gives what the whole model gives with a crack on x <= a along that plane: a pair is
/// folded exactly when its line does not cross that crack, by the same predicates and tie rule.

#include <array>
#include <cstdint>
#include <limits>

#include "crampon/core/vector.hpp"

namespace crampon {

/// The plane x[axis] = at, restricted to from[k] <= x[k] <= to[k] for the other axes k.
struct SymmetryPlane {
  int axis = 0;
  double at = 0;  ///< m; the very coordinate of the grid's nodes there (conventions 21), since nodes are compared with it exactly
  int side = 1;   ///< +1 when the body lies at larger coordinates, -1 at smaller
  /// m; not finite: unbounded. The entries of `axis` are ignored.
  std::array<double, 3> from{-infinity, -infinity, -infinity}, to{infinity, infinity, infinity};
  std::uint16_t condition = 0;  ///< under which the model has it among the conditions on nodes

  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

/// Does the particle see the node in the mirror, that is: is the node strictly beyond the plane, the particle not, and does the line
/// between them meet the plane within its part? The part's ends belong to it, as touching a tip is no crossing.
template <int Dim>
bool folds(const SymmetryPlane& plane, const Vec<Dim>& particle, const Vec<Dim>& node);

/// Does the node lie on the plane's part, ends included? Such nodes have no normal momentum.
template <int Dim>
bool on_plane(const SymmetryPlane& plane, const Vec<Dim>& node);

}  // namespace crampon
