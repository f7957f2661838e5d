#pragma once
#include "crampon/core/pack.hpp"
#include "crampon/shape/profile.hpp"

namespace crampon {

/// Cubic B-spline with knots at the nodes: 2/3 - r^2 + r^3/2 up to r = 1 cell from the node, (2 - r)^3/6 up to 2 (Steffen et al. 2008).
struct CubicBsplineShape {
  static constexpr const char* name = "cubic_bspline";
  static constexpr const char* help = "cubic B-spline";
  static constexpr int width = 4;
  static constexpr int below = 1;         ///< nodes below the cell
  static constexpr double bin_shift = 0;  ///< particles are binned by cell
  static constexpr bool has_domains = false;
  static constexpr ProfileBoxes boxes{.cell = 4};
  static constexpr double uneven_edge = 1.6;
  /// Cells from a particle to the furthest node that it can reach.
  static constexpr double reach(double /*half_size*/) { return 2; }

  /// f: distance from the lower node of the cell in cells, in [0, 1].
  static void weights(Pack f, double /*half_size*/, double inverse_cell, Pack* N, Pack* dN) {
    const Pack right = f, left = 1. - f;
    const Pack right_2 = right * right, left_2 = left * left, both = right * left;
    N[0] = (1. / 6) * (left_2 * left);
    N[3] = (1. / 6) * (right_2 * right);
    // With 1 = left + right every term is positive: values sum up to one without cancellation.
    N[1] = (2. / 3) * left_2 * left + both * (2. * left + right) + (1. / 6) * right_2 * right;
    N[2] = (2. / 3) * right_2 * right + both * (2. * right + left) + (1. / 6) * left_2 * left;
    dN[0] = left_2 * splat(-0.5 * inverse_cell);
    dN[3] = right_2 * splat(0.5 * inverse_cell);
    dN[1] = right * (1.5 * right - 2.) * splat(inverse_cell);
    dN[2] = left * (2. - 1.5 * left) * splat(inverse_cell);
  }
};

}  // namespace crampon
