#pragma once
/// A crack as tests of crossing and bins see it: its facets, and which of them meet.

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/geometry/facet.hpp"

namespace crampon {

/// A facet by its place in the list of its crack.
using FacetId = std::uint32_t;
inline constexpr FacetId no_facet = 0xffffffffu;

/// Per part of the outline of a facet, the facet of the same crack beyond it, or no_facet where the crack ends. In the plane part k is vertex k
/// of the facet, and an end is a tip. In space it is the edge from vertex k to the next, and an end belongs to the front.
template <int Dim>
using FacetNeighbours = std::array<FacetId, Dim>;

/// Views of one crack; who makes it keeps what they show.
template <int Dim>
struct CrackMesh {
  std::span<const Vec<Dim>> vertices;                ///< m
  std::span<const Facet<Dim>> facets;                ///< all turned the same way
  std::span<const FacetNeighbours<Dim>> neighbours;  ///< per facet
  std::span<const Vec<Dim>> normals{};               ///< per facet, unit vectors from above to below; may be empty
  std::span<const Vec<Dim>> original_normals{};      ///< what these were at the start of the run; may be empty
};

/// Which facet of which crack.
struct FacetRef {
  std::uint32_t crack = 0;
  FacetId facet = 0;
  friend constexpr bool operator==(const FacetRef&, const FacetRef&) = default;
  friend constexpr auto operator<=>(const FacetRef&, const FacetRef&) = default;
};

/// The neighbours of all facets of one crack.
/// \param vertices  how many vertices the crack has
/// \param closed    the last vertex is at the same place as the first, and counts as the same
/// Throws std::invalid_argument when more than two facets meet at one part of their outlines, or two that are not turned the same way.
template <int Dim>
std::vector<FacetNeighbours<Dim>> find_neighbours(std::span<const Facet<Dim>> facets, std::size_t vertices, bool closed = false);

/// The unit normals of all facets of one crack, from above to below.
template <int Dim>
std::vector<Vec<Dim>> facet_normals(std::span<const Vec<Dim>> vertices, std::span<const Facet<Dim>> facets) {
  std::vector<Vec<Dim>> normals;
  normals.reserve(facets.size());
  for (const Facet<Dim>& facet : facets) normals.push_back(facet_normal<Dim>(vertices, facet));
  return normals;
}

/// The facets of a path in the plane: one from each of its vertices to the next.
std::vector<Facet<2>> path_facets(std::size_t vertices);

}  // namespace crampon
