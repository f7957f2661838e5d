#pragma once
/// Does the line from a particle to a node cross a crack? (N03 Task 1; docs/theory/crossing.md; conventions 15-22)
///
/// The node is thought moved by an infinitely small vector, so that it never lies on a crack and every particle sees it on the same side.
/// A particle on the crack counts as above. A line that touches a tip does not cross. Whether one facet is crossed says crack/facet_test.hpp;
/// what follows for the crack is the same in the plane and in space, and stands here.

#include <span>

#include "crampon/core/vector.hpp"
#include "crampon/crack/crack_mesh.hpp"

namespace crampon {

/// The facets of one crack that the line from a particle to a node crosses.
template <int Dim>
struct Crossing {
  int above = 0, below = 0;  ///< number of crossed facets with the particle above, below
  Vec<Dim> normal_sum{};     ///< sum of the unit normals of the crossed facets, from above to below
  Vec<Dim> original_sum{};   ///< sum of what these normals were at the start

  bool crosses() const { return ((above + below) & 1) != 0; }
  /// Side of the particle when the line crosses: +1 above, -1 below (conventions 17).
  int side() const { return (above > below) - (above < below); }
};

/// What the line from particle to node crosses among the given facets of one crack (ascending, none twice). Facets left out must be out of the
/// line's reach (crack/facet_bins.hpp finds the others). FacetRef::crack is not looked at.
template <int Dim>
Crossing<Dim> cross_crack(const CrackMesh<Dim>& crack, std::span<const FacetRef> facets, const Vec<Dim>& particle, const Vec<Dim>& node);

/// The same among all facets.
template <int Dim>
Crossing<Dim> cross_crack(const CrackMesh<Dim>& crack, const Vec<Dim>& particle, const Vec<Dim>& node);

/// cross_crack for every node of a particle's stencil; what depends on the particle alone is done once.
/// \param nodes, crossings  one entry per node, of equal length; crossings are overwritten
template <int Dim>
void cross_stencil(const CrackMesh<Dim>& crack, std::span<const FacetRef> facets, const Vec<Dim>& particle, std::span<const Vec<Dim>> nodes,
                   std::span<Crossing<Dim>> crossings);

}  // namespace crampon
