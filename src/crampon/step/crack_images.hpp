#pragma once
/// Cracks at symmetry planes and at their ends, as the whole body has them (docs/theory/crossing.md; conventions 29).

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "crampon/crack/symmetry_fold.hpp"
#include "crampon/step/crack_view.hpp"

namespace crampon {

/// A plane with what counts as lying on it.
template <int Dim>
struct Mirror {
  const SymmetryPlane& plane;
  double touching;  ///< m

  double height(const Vec<Dim>& x) const { return plane.side * (x[static_cast<std::size_t>(plane.axis)] - plane.at); }
  bool inside(const Vec<Dim>& x) const { return height(x) > touching; }
  Vec<Dim> image(Vec<Dim> x) const {
    auto& across = x[static_cast<std::size_t>(plane.axis)];
    across = 2 * plane.at - across;
    return x;
  }
  Vec<Dim> turned(Vec<Dim> n) const {
    n[static_cast<std::size_t>(plane.axis)] *= -1;
    return n;
  }
  /// Where the line from a point inside to one that is not meets the plane; none beside the plane's part.
  std::optional<Vec<Dim>> meeting(const Vec<Dim>& inner, const Vec<Dim>& outer) const;
};

/// The image of a crack: its facets are turned so that above stays above. Vertices and facets are in the reverse order.
template <int Dim>
SeenCrack<Dim> image_of(const SeenCrack<Dim>& crack, const Mirror<Dim>& mirror);

/// Does a crack lie before the mirror with some vertex nearer than `reach`, m? What is partly behind, where there is no body, has no image.
template <int Dim>
bool comes_near(const SeenCrack<Dim>& crack, const Mirror<Dim>& mirror, double reach);

/// A crack that ends on a mirror goes on as its image behind it: the two are one crack of the whole body. When this one does, its image is
/// joined to it, all but SeenCrack::neighbours, and the answer is true. In space edges may end on a mirror; none is joined yet.
template <int Dim>
bool join_image(SeenCrack<Dim>& crack, const Mirror<Dim>& mirror);

/// Lines from particles to nodes reach this far beyond an edge, in cells: from a particle on it over the stencil in both directions, to a crack
/// that leaves the body at a slant. stencil: cells from a particle to its furthest node.
inline double reach_beyond_edges(double stencil) { return 4 * std::fmax(1, stencil / 1.5); }

/// The vertices of a path in the plane, with what lies beyond them at ends that are no tips, straight on.
/// \param extension  how far beyond the start and the end, m; 0: a tip
std::vector<Vec<2>> extended(const std::vector<Vec<2>>& vertices, const std::array<double, 2>& extension);

}  // namespace crampon
