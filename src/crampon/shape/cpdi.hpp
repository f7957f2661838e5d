#pragma once
#include "crampon/shape/domain.hpp"
#include "crampon/shape/profile.hpp"

namespace crampon {

/// Linear functions over domains that stretch, shear and turn with the nodes (shape/domain.hpp; docs/decisions/0019-domains-that-stretch.md), with
/// uGIMP's stencil.
struct CpdiShape {
  static constexpr const char* name = "cpdi";
  static constexpr const char* help = "CPDI, linear functions over domains that stretch with the body";
  static constexpr int width = 3;
  static constexpr int below = 1;           ///< nodes below the nearest
  static constexpr double bin_shift = 0.5;  ///< particles are binned by nearest node
  static constexpr bool has_domains = true;
  static constexpr ProfileBoxes boxes{.cell = 2, .ends = 1};
  static constexpr double uneven_edge = 2.2;
  /// Cells from a particle to the furthest node that it can reach.
  static constexpr double reach(double) { return 1 + largest_half_extent; }
};

}  // namespace crampon
