#pragma once
// Random and degenerate cracks for the tests of crossing.

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/crack/crossing.hpp"

namespace crampon::testing {

using Rng = std::mt19937_64;
using Points = std::vector<Vec<2>>;

inline int pick(Rng& rng, int low, int high) { return std::uniform_int_distribution<int>(low, high)(rng); }
inline double draw(Rng& rng, double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }

/// A polyline that owns its points, as the mesh of a crack.
struct Polyline {
  Points vertices;
  std::vector<Facet<2>> facets;
  std::vector<FacetNeighbours<2>> neighbours;
  std::vector<Vec<2>> normals;
  bool closed;
  Polyline(Points v, bool closed_ = false)
      : vertices(std::move(v)),
        facets(path_facets(vertices.size())),
        neighbours(find_neighbours<2>(facets, vertices.size(), closed_)),
        normals(facet_normals<2>(vertices, facets)),
        closed(closed_) {}
  CrackMesh<2> mesh() const { return {vertices, facets, neighbours, normals}; }
};

}  // namespace crampon::testing
