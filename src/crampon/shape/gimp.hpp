#pragma once
#include "crampon/core/pack.hpp"
#include "crampon/shape/profile.hpp"

namespace crampon {

/// uGIMP: linear functions averaged over an undeformed particle (docs/theory/kinematics.md, shape functions; Bardenhagen & Kober 2004).
struct GimpShape {
  static constexpr const char* name = "gimp";
  static constexpr const char* help = "uGIMP, linear functions averaged over undeformed particles";
  static constexpr int width = 3;
  static constexpr int below = 1;             ///< nodes below the nearest
  static constexpr double bin_shift = 0.5;    ///< particles are binned by nearest node
  static constexpr bool has_domains = false;  ///< that go with the nodes: CpdiShape
  static constexpr ProfileBoxes boxes{.cell = 2, .particle = 1};
  static constexpr double uneven_edge = 2.2;  ///< domains do not change with what their particles stand for
  /// Cells from a particle to the furthest node that it can reach.
  static constexpr double reach(double half_size) { return 1 + half_size; }

  /// f - 1/2 is the distance to the nearest (middle) node in cells, in [-1/2, 1/2]; half_size: particle half edge in cells.
  /// Branch-free: t is the part of the particle on either side of the middle node.
  static void weights(Pack f, double half_size, double inverse_cell, Pack* N, Pack* dN) {
    const Pack l = splat(half_size), d = f - 0.5, zero = splat(0.);
    const Pack t = lane_max(-l, lane_min(l, d));
    const Pack right = l + t, left = l - t, scale = splat(1 / (4 * half_size));
    N[2] = fused(right * right, scale, lane_max(d - l, zero));
    N[0] = fused(left * left, scale, lane_max(-l - d, zero));
    N[1] = 1. - N[0] - N[2];
    dN[2] = right * splat(inverse_cell / (2 * half_size));
    dN[0] = left * splat(-inverse_cell / (2 * half_size));
    dN[1] = t * splat(-inverse_cell / half_size);
  }
};

}  // namespace crampon
