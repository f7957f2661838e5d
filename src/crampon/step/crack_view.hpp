#pragma once
/// The cracks as they lie in one step, from when velocity fields are assigned (Task 0) until they move (Task 8).

#include <vector>

#include "crampon/crack/crossing.hpp"
#include "crampon/crack/facet_bins.hpp"

namespace crampon {

/// A crack as the whole body has it: one that ends on a symmetry plane goes on as its image behind the plane.
struct SeenCrack {
  std::vector<Vec<2>> vertices;                   ///< with those at the ends of its extensions, m
  std::vector<Vec<2>> normals, original_normals;  ///< of its segments
  bool closed = false;
};

/// Paths and bins as the crossing tests want them; empty in 3D, where cracks are still to come.
struct CrackView {
  std::size_t cracks = 0;
  /// [crack], then [plane][crack]: images in symmetry planes of cracks that come near one without ending on it; most are empty. An image is a
  /// crack of its own, with the same laws.
  std::vector<SeenCrack> seen;
  std::vector<CrackPath> paths;  ///< into `seen`
  FacetBins bins;                ///< by what the particles of a cell reach
};

}  // namespace crampon
