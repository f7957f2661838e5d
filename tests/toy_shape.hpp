#pragma once
/// A shape function that exists in a test (tests/add_shape_function.py puts it among the others): the quadratic B-spline averaged over an undeformed
/// particle. One declaration after the other, so that the test can leave each of them out.

#include "crampon/core/pack.hpp"
#include "crampon/shape/profile.hpp"

namespace crampon {

struct ToyShape {
  static constexpr const char* name = "toy";
  static constexpr const char* help = "quadratic B-spline averaged over the particle, in a test";
  static constexpr int width = 4;
  static constexpr int below = 1;
  static constexpr double bin_shift = 0;
  static constexpr bool has_domains = false;
  static constexpr ProfileBoxes boxes{.cell = 3, .particle = 1};
  static constexpr double uneven_edge = 2.2;
  static constexpr double reach(double half_size) { return 1.5 + half_size; }

  static void weights(Pack f, double half_size, double inverse_cell, Pack* N, Pack* dN) {
    // Truncated powers from the ends inwards: nothing is left beyond them.
    constexpr double ends[] = {1.5, 0.5, -0.5, -1.5}, factor[] = {1, -3, 3, -1};
    for (int n = 0; n < 4; ++n) {
      const Pack xi = f + (1. - n), r = lane_max(xi, -xi);
      N[n] = dN[n] = splat(0.);
      for (int e = 0; e < 4; ++e) {
        for (const double side : {1., -1.}) {
          const Pack left = lane_max(splat(ends[e] + side * half_size) - r, splat(0.));
          N[n] = N[n] + splat(side * factor[e] / (12 * half_size)) * left * left * left;
          dN[n] = dN[n] + splat(-side * factor[e] * inverse_cell / (4 * half_size)) * left * left;
        }
      }
      N[n] = lane_max(N[n], splat(0.));
      for (int l = 0; l < lanes; ++l) dN[n][l] *= xi[l] < 0 ? -1 : 1;
    }
  }
};

}  // namespace crampon
