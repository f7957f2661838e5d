#pragma once
/// The cracks as they lie in one step, from when velocity fields are assigned (Task 0) until they move (Task 8).

#include <vector>

#include "crampon/crack/crack_mesh.hpp"
#include "crampon/crack/facet_bins.hpp"

namespace crampon {

/// A crack as the whole body has it: one that ends on a symmetry plane goes on as its image behind the plane.
template <int Dim>
struct SeenCrack {
  std::vector<Vec<Dim>> vertices;  ///< with those at the ends of its extensions, m
  std::vector<Facet<Dim>> facets;
  std::vector<FacetNeighbours<Dim>> neighbours;     ///< per facet
  std::vector<Vec<Dim>> normals, original_normals;  ///< per facet
  bool closed = false;                              ///< in the plane: the last vertex is at the place of the first

  CrackMesh<Dim> mesh() const { return {vertices, facets, neighbours, normals, original_normals}; }
};

/// Meshes and bins as the crossing tests want them.
template <int Dim>
struct CrackView {
  std::size_t cracks = 0;
  /// [crack], then [plane][crack]: images in symmetry planes of cracks that come near one without ending on it; most are empty. An image is a
  /// crack of its own, with the same laws.
  std::vector<SeenCrack<Dim>> seen;
  std::vector<CrackMesh<Dim>> meshes;  ///< of `seen`
  FacetBins<Dim> bins;                 ///< by what the particles of a cell reach
};

}  // namespace crampon
