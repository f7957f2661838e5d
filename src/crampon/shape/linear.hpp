#pragma once
#include "crampon/core/pack.hpp"
#include "crampon/shape/profile.hpp"

namespace crampon {

/// Linear (4- and 8-node) shape functions (docs/theory/kinematics.md, shape functions; N03 Eq. 24).
struct LinearShape {
  static constexpr const char* name = "linear";
  static constexpr const char* help = "bilinear, in 3D trilinear";
  static constexpr int width = 2;         ///< nodes per axis
  static constexpr int below = 0;         ///< of them below the node that gives a particle its bin
  static constexpr double bin_shift = 0;  ///< particles are binned by cell
  static constexpr bool has_domains = false;
  static constexpr ProfileBoxes boxes{.cell = 2};
  /// Half sizes of particles by which the middle of one that follows the boundary may lie behind it (MaterialField::uneven_edge).
  static constexpr double uneven_edge = 1.2;
  /// Cells from a particle to the furthest node that it can reach.
  static constexpr double reach(double /*half_size*/) { return 1; }

  /// f: distance from the base node in cells, in [0, 1]. N and dN/dx (1/m) at the base node and the next.
  static void weights(Pack f, double /*half_size*/, double inverse_cell, Pack* N, Pack* dN) {
    // A particle exactly on a node's line has N = 0 but dN != 0 at the far node: a force on a node without mass, and momentum
    // would be lost. It is taken just inside its cell instead (conventions 38).
    f = lane_max(splat(1e-12), lane_min(splat(1 - 1e-12), f));
    N[0] = 1. - f;
    N[1] = f;
    dN[0] = splat(-inverse_cell);
    dN[1] = splat(inverse_cell);
  }
};

}  // namespace crampon
