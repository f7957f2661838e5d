#pragma once
#include "crampon/shape/domain.hpp"

namespace crampon {

/// Linear functions over domains that stretch, shear and turn with the nodes (shape/domain.hpp; docs/decisions/0019-domains-that-stretch.md), with
/// uGIMP's stencil.
struct CpdiShape {
  static constexpr int width = 3;
  static constexpr double bin_shift = 0.5;  ///< particles are binned by nearest node
  static constexpr bool has_domains = true;
  /// Cells from a particle to the furthest node that it can reach.
  static constexpr double reach(double) { return 1 + largest_half_extent; }
};

}  // namespace crampon
