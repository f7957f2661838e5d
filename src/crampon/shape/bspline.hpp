#pragma once
#include "crampon/core/pack.hpp"
#include "crampon/shape/profile.hpp"

namespace crampon {

/// Quadratic B-spline, docs/theory/kinematics.md, shape functions (Steffen et al. 2008).
struct BsplineShape {
  static constexpr const char* name = "bspline";
  static constexpr const char* help = "quadratic B-spline";
  static constexpr int width = 3;
  static constexpr int below = 1;           ///< nodes below the nearest
  static constexpr double bin_shift = 0.5;  ///< particles are binned by nearest node
  static constexpr bool has_domains = false;
  static constexpr ProfileBoxes boxes{.cell = 3};
  static constexpr double uneven_edge = 1.4;
  /// Cells from a particle to the furthest node that it can reach.
  static constexpr double reach(double /*half_size*/) { return 1.5; }

  /// f - 1/2 is the distance to the nearest (middle) node in cells, in [-1/2, 1/2].
  static void weights(Pack f, double /*half_size*/, double inverse_cell, Pack* N, Pack* dN) {
    const Pack right = f, left = 1. - f, d = f - 0.5;
    N[0] = 0.5 * left * left;
    N[2] = 0.5 * right * right;
    N[1] = 0.75 - d * d;
    dN[0] = left * splat(-inverse_cell);
    dN[2] = right * splat(inverse_cell);
    dN[1] = d * splat(-2 * inverse_cell);
  }
};

}  // namespace crampon
