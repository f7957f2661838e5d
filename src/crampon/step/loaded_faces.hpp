#pragma once
/// Faces of bodies under load, as columns of particles (docs/theory/loads.md).

#include <cstdint>
#include <vector>

#include "crampon/core/vector.hpp"

namespace crampon {

/// An outer face of a particle's undeformed domain, and the row of particles behind it.
struct FaceColumn {
  std::uint32_t load = 0;     ///< index into Model::loads
  std::uint32_t surface = 0;  ///< the outermost particle, index into LoadedFaces::particles
  std::uint32_t first_link = 0, end_link = 0;
  std::uint8_t axis = 0;  ///< of the face's outward normal ...
  double direction = 1;   ///< ... and its sign
  double area = 0;        ///< of the undeformed face, m2
  double share = 1;       ///< traction: part of that area which counts; faces of cells are more than the slope that they stand for
};

/// A particle's part in a column.
struct FaceLink {
  std::uint32_t column = 0, particle = 0;  ///< indices into LoadedFaces
  double depth = 0;                        ///< of the particle below the face, undeformed, m
  double flux = 0;                         ///< V_p phi, m3: phi = 1 near the face and 0 at the end of the column
  double source = 0;                       ///< V_p dphi/dn, n outward, m2
  bool ends = true;       ///< nodes beyond the face's reach take nothing; false where the row ends before that, and phi alone decides
  bool mirrored = false;  ///< of the image of the face in a symmetry plane
};

/// All faces under load.
template <int Dim>
struct LoadedFaces {
  std::vector<std::uint32_t> particles;    ///< ids, ascending: all that have a part
  std::vector<FaceColumn> columns;         ///< by load
  std::vector<FaceLink> links;             ///< by column
  std::vector<std::uint32_t> by_particle;  ///< links in the order of their particles
  std::vector<std::uint32_t> first_of;     ///< per particle, and one more: its first in by_particle

  bool empty() const { return columns.empty(); }
};

}  // namespace crampon
