#pragma once
/// Cracks: vertices without mass, joined by facets (N03 section 2; docs/theory/space.md, cracks in memory).

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/state/layers.hpp"

namespace crampon {

using VertexId = std::uint32_t;

/// A particle that carries a point of a crack's surface along (step/crack_carriers.hpp).
struct Carrier {
  std::uint32_t particle = 0;  ///< id
  std::uint8_t flip = 0;       ///< bit k: it is the particle's image in a mirror, and component k of its displacement is reversed
  double weight = 0;           ///< of its displacement in that of the point
};
/// Per vertex. The weights of a point add up to 1; a point without carriers goes with the plane.
using Carriers = std::vector<std::vector<Carrier>>;

/// One crack. In 2D the vertices of facet k are k and k + 1 of a directed polyline; "above" is left of it (conventions, words and signs).
template <int Dim>
struct Crack {
  std::string name;
  bool fixed = false;              ///< the plane stays where it is
  bool closed = false;             ///< last vertex equals the first: no tips
  std::vector<Vec<Dim>> plane;     ///< present vertices, m
  std::vector<Vec<Dim>> upper;     ///< points of the upper surface, m
  std::vector<Vec<Dim>> lower;     ///< points of the lower surface, m
  std::vector<Vec<Dim>> original;  ///< vertices at the start, m
  std::vector<std::array<VertexId, Dim>> facets;
  Carriers upper_carriers, lower_carriers;  ///< of the surface points
  /// How far the path goes on beyond its start and its end for those who ask what it cuts, m; 0: the end is a tip (run/crack_ends.hpp).
  std::array<double, 2> extension{};
  /// Bit k of the start and of the end: it lies on a mirror across axis k, behind which the crack goes on as its image.
  std::array<std::uint8_t, 2> mirrored{};
};

template <int Dim>
struct Cracks {
  std::vector<Crack<Dim>> list;
  bool empty() const { return list.empty(); }
  std::size_t size() const { return list.size(); }
};

/// Unit normal of a segment, from above to below: (dy, -dx)/L.
inline Vec<2> segment_normal(const Vec<2>& a, const Vec<2>& b) { return normalized(Vec<2>{{b[1] - a[1], a[0] - b[0]}}); }

}  // namespace crampon
