#pragma once
/// Does the line from a particle to a node cross a crack? (N03 Task 1; docs/theory/crossing.md; conventions 15-22)
///
/// The node is thought moved to node + (eps, eps^2), so that it never lies on a crack and every particle sees it on the same side.
/// A particle on the crack counts as above. A line that touches a tip does not cross.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include "crampon/core/predicates.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// Which ends of a segment are tips of its crack.
enum class TipRule : std::uint8_t { none = 0, start = 1, end = 2, both = 3 };

/// A facet of a crack; in the plane the segment between vertices `segment` and `segment` + 1.
struct FacetRef {
  std::uint32_t crack = 0;
  std::uint32_t segment = 0;
  friend constexpr bool operator==(const FacetRef&, const FacetRef&) = default;
  friend constexpr auto operator<=>(const FacetRef&, const FacetRef&) = default;
};

/// One crack as the crossing test sees it: a directed polyline; above is to its left.
struct CrackPath {
  std::span<const Vec<2>> vertices;            ///< m; of a closed path the first and last are equal
  std::span<const Vec<2>> normals;             ///< of segment s from vertex s to s + 1: (dy, -dx)/L, from above to below; may be empty
  bool closed = false;                         ///< no tips
  std::span<const Vec<2>> original_normals{};  ///< the same at the start of the run; may be empty

  std::size_t segment_count() const { return vertices.size() < 2 ? 0 : vertices.size() - 1; }
  TipRule tip_rule(std::size_t segment) const {
    if (closed) return TipRule::none;
    return static_cast<TipRule>((segment == 0 ? 1 : 0) | (segment + 1 == segment_count() ? 2 : 0));
  }
};

/// The segments of one crack that the line from a particle to a node crosses.
struct Crossing {
  int above = 0, below = 0;  ///< number of crossed segments with the particle above, below
  Vec<2> normal_sum{};       ///< sum of the unit normals of the crossed segments, from above to below
  Vec<2> original_sum{};     ///< sum of what these normals were at the start

  bool crosses() const { return ((above + below) & 1) != 0; }
  /// Side of the particle when the line crosses: +1 above, -1 below (conventions 17).
  int side() const { return (above > below) - (above < below); }
};

/// Is the segment a -> b crossed? A particle exactly at a or b is taken as if the segment went straight on beyond that end: the
/// crossing belongs to the segment that ends there; cross_path knows the neighbour and treats corners too.
bool segment_crossed(const Vec<2>& particle, const Vec<2>& node, const Vec<2>& a, const Vec<2>& b, TipRule tips);

/// What the line from particle to node crosses among the given segments of one crack (ascending, none twice). Segments left out
/// must be out of the line's reach (crack/facet_bins.hpp finds the others). FacetRef::crack is not looked at.
Crossing cross_path(const CrackPath& crack, std::span<const FacetRef> facets, const Vec<2>& particle, const Vec<2>& node);

/// The same among all segments.
Crossing cross_path(const CrackPath& crack, const Vec<2>& particle, const Vec<2>& node);

/// cross_path for every node of a particle's stencil; what depends on the particle alone is done once.
/// \param nodes, crossings  one entry per node, of equal length; crossings are overwritten
void cross_stencil(const CrackPath& crack, std::span<const FacetRef> facets, const Vec<2>& particle, std::span<const Vec<2>> nodes,
                   std::span<Crossing> crossings);

}  // namespace crampon
