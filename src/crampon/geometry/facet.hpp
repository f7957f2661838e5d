#pragma once
/// Facets, of which cracks are made: segments in the plane, triangles in space (docs/theory/space.md, cracks in memory).

#include <array>
#include <cstdint>

#include "crampon/core/vector.hpp"

namespace crampon {

using VertexId = std::uint32_t;

/// The vertices of a facet in their order. In the plane above is to the left of the way from the first to the second. In space who looks from
/// above sees the three anticlockwise.
template <int Dim>
using Facet = std::array<VertexId, Dim>;

/// Across a facet, from above to below. Its length is that of the segment, m, or the area of the triangle, m2.
inline Vec<2> area_vector(const Vec<2>& a, const Vec<2>& b) { return {{b[1] - a[1], a[0] - b[0]}}; }
inline Vec<3> area_vector(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
  const Vec<3> u = c - a, v = b - a;
  return Vec<3>{{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]}} * 0.5;
}

/// The same of a facet by its vertices. vertices: anything with points under the numbers of vertices, m.
template <int Dim, class Points>
Vec<Dim> area_vector(const Points& vertices, const Facet<Dim>& facet) {
  if constexpr (Dim == 2) {
    return area_vector(vertices[facet[0]], vertices[facet[1]]);
  } else {
    return area_vector(vertices[facet[0]], vertices[facet[1]], vertices[facet[2]]);
  }
}

/// Unit normal of a facet, from above to below; zero when the facet has no area.
template <int Dim, class Points>
Vec<Dim> facet_normal(const Points& vertices, const Facet<Dim>& facet) {
  return normalized(area_vector<Dim>(vertices, facet));
}

/// Unit normal of a segment, from above to below: (dy, -dx)/L.
inline Vec<2> segment_normal(const Vec<2>& a, const Vec<2>& b) { return normalized(area_vector(a, b)); }

}  // namespace crampon
