#include "crampon/crack/crack_mesh.hpp"

#include <algorithm>
#include <stdexcept>

namespace crampon {

namespace {

/// An edge of a triangle, by its vertices, and whose it is.
struct Edge {
  VertexId low, high;  ///< the lower and the higher of its vertices
  FacetId facet;
  std::size_t number;  ///< among the edges of the facet
  bool ascending;      ///< the facet runs along it from `low` to `high`

  std::array<VertexId, 2> ends() const { return {low, high}; }
};

}  // namespace

template <int Dim>
std::vector<FacetNeighbours<Dim>> find_neighbours(std::span<const Facet<Dim>> facets, std::size_t vertices, bool closed) {
  std::vector<FacetNeighbours<Dim>> out(facets.size());
  for (FacetNeighbours<Dim>& of_facet : out) of_facet.fill(no_facet);
  const auto one_of_two = [&](VertexId v) { return closed && v + 1 == vertices ? VertexId{0} : v; };
  const char* const wrong = "the facets of a crack branch, or they are not turned the same way";
  const auto join = [&](FacetId& here, FacetId there) {
    if (here != no_facet) throw std::invalid_argument(wrong);
    here = there;
  };
  if constexpr (Dim == 2) {
    // A vertex ends one segment at the most and starts one. This is done in every step, so without sorting.
    std::vector<FacetId> starting(vertices, no_facet), ending(vertices, no_facet);
    for (FacetId f = 0; f < facets.size(); ++f) {
      join(starting[one_of_two(facets[f][0])], f);
      join(ending[one_of_two(facets[f][1])], f);
    }
    for (FacetId f = 0; f < facets.size(); ++f) out[f] = {ending[one_of_two(facets[f][0])], starting[one_of_two(facets[f][1])]};
  } else {
    std::vector<Edge> edges;
    for (FacetId f = 0; f < facets.size(); ++f) {
      for (std::size_t k = 0; k < Dim; ++k) {
        const VertexId a = one_of_two(facets[f][k]), b = one_of_two(facets[f][(k + 1) % Dim]);
        edges.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends() < b.ends(); });
    for (std::size_t i = 1; i < edges.size(); ++i) {
      const Edge &a = edges[i - 1], &b = edges[i];
      if (a.ends() != b.ends()) continue;
      if (a.ascending == b.ascending) throw std::invalid_argument(wrong);
      join(out[a.facet][a.number], b.facet);
      join(out[b.facet][b.number], a.facet);
    }
  }
  return out;
}

std::vector<Facet<2>> path_facets(std::size_t vertices) {
  std::vector<Facet<2>> facets;
  facets.reserve(vertices);
  for (VertexId v = 0; v + 1 < vertices; ++v) facets.push_back({v, v + 1});
  return facets;
}

template std::vector<FacetNeighbours<2>> find_neighbours<2>(std::span<const Facet<2>>, std::size_t, bool);
template std::vector<FacetNeighbours<3>> find_neighbours<3>(std::span<const Facet<3>>, std::size_t, bool);

}  // namespace crampon
