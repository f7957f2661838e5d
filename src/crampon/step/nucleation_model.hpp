#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crampon/geometry/region.hpp"

namespace crampon {

/// When and where cracks start (docs/theory/fracture.md, nucleation).
struct NucleationModel {
  std::string name;
  std::vector<bool> materials;  ///< per material: cracks start in it
  RegionPtr region;             ///< of places in the undeformed bodies where they start; null: everywhere
  double strength = 0;          ///< Pa
  double radius = 0;            ///< over which stress is averaged, m
  double length = 0;            ///< of a new crack, m
  double distance = 0;          ///< from its centre to other cracks and to symmetry planes, at least, m
  double interval = 0;          ///< between two looks, s
  std::uint32_t first = 0;      ///< number of the first of its cracks; the others follow it
  std::int64_t most = 0;        ///< how many there are
};

}  // namespace crampon
