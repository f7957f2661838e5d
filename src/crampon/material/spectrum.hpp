#pragma once
/// Functions of symmetric tensors through their eigenvalues, four tensors at once.

#include "crampon/core/pack.hpp"

namespace crampon {

/// Of {xx, yy, xy}: eigenvalues and the double angle of the first axis.
struct PlaneSpectrum {
  Pack value[2];
  Pack cos2, sin2;

  explicit PlaneSpectrum(Pack xx, Pack yy, Pack xy) {
    const Pack mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy), radius = lane_sqrt(half * half + xy * xy);
    value[0] = mean + radius;
    value[1] = (xx * yy - xy * xy) / value[0];  // the product of both: mean - radius would cancel
    const Pack scale = 1. / (radius + least);   // without a radius every axis will do
    cos2 = half * scale, sin2 = xy * scale;
  }
  /// {xx, yy, xy} of the tensor with these eigenvalues and the same axes, from their sum and the first less the second.
  void compose(Pack sum, Pack difference, Pack* a) const {
    a[0] = 0.5 * (sum + difference * cos2), a[1] = 0.5 * (sum - difference * cos2), a[2] = 0.5 * difference * sin2;
  }

 private:
  static constexpr double least = 1e-300;
};

/// Of {xx, yy, zz, xy, yz, xz}: eigenvalues and axes, by Jacobi rotations. Each sweep squares what is left beside the diagonal, so that five reach
/// round-off from anywhere (spectrum_test).
struct SpaceSpectrum {
  Pack value[3];
  Pack axis[9];  ///< [component * 3 + number]

  explicit SpaceSpectrum(const Pack* a) {
    Pack A[3][3] = {{a[0], a[3], a[5]}, {a[3], a[1], a[4]}, {a[5], a[4], a[2]}};
    for (int c = 0; c < 9; ++c) axis[c] = splat(c % 4 == 0 ? 1. : 0.);
    for (int sweep = 0; sweep < 5; ++sweep) {
      rotate(A, 0, 1);
      rotate(A, 0, 2);
      rotate(A, 1, 2);
    }
    for (int k = 0; k < 3; ++k) value[k] = A[k][k];
  }
  /// {xx, yy, zz, xy, yz, xz} of the tensor with other eigenvalues and the same axes.
  void compose(const Pack* values, Pack* a) const {
    const auto sum = [&](int i, int j) {
      return values[0] * axis[3 * i] * axis[3 * j] + values[1] * axis[3 * i + 1] * axis[3 * j + 1] +
             values[2] * axis[3 * i + 2] * axis[3 * j + 2];
    };
    a[0] = sum(0, 0), a[1] = sum(1, 1), a[2] = sum(2, 2), a[3] = sum(0, 1), a[4] = sum(1, 2), a[5] = sum(0, 2);
  }

 private:
  void rotate(Pack A[3][3], int p, int q) {
    const Pack d = A[q][q] - A[p][p], twice = 2. * A[p][q];
    const Pack length = lane_max(d, -d) + lane_sqrt(d * d + twice * twice) + 1e-300;
    const Pack tangent = (d < 0. ? -twice : twice) / length;  // of the smaller of the two angles
    const Pack c = 1. / lane_sqrt(1. + tangent * tangent), s = tangent * c, moved = tangent * A[p][q];
    const int r = 3 - p - q;
    const Pack rp = A[r][p], rq = A[r][q];
    A[p][p] -= moved, A[q][q] += moved;
    A[p][q] = A[q][p] = splat(0.);
    A[r][p] = A[p][r] = c * rp - s * rq;
    A[r][q] = A[q][r] = s * rp + c * rq;
    for (int i = 0; i < 3; ++i) {
      const Pack vp = axis[3 * i + p], vq = axis[3 * i + q];
      axis[3 * i + p] = c * vp - s * vq;
      axis[3 * i + q] = s * vp + c * vq;
    }
  }
};

}  // namespace crampon
