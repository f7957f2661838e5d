#pragma once
/// The cracks as they lie in one step, from when velocity fields are assigned (Task 0) until they move (Task 8).

#include <vector>

#include "crampon/crack/crossing.hpp"
#include "crampon/crack/facet_bins.hpp"

namespace crampon {

/// Paths and bins as the crossing tests want them; empty in 3D, where cracks are still to come.
struct CrackView {
  std::vector<std::vector<Vec<2>>> normals, original_normals;  ///< of segments, per crack
  std::vector<CrackPath> paths;                                ///< per crack; into the normals and State::cracks
  FacetBins bins;                                              ///< by what the particles of a cell reach
};

}  // namespace crampon
