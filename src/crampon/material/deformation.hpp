#pragma once
/// Deformation gradients of four particles. 2D history: {Fxx, Fxy, Fyx, Fyy, Fzz}; 3D: row by row, 9 components.

#include "crampon/core/pack.hpp"
#include "crampon/state/particles.hpp"

namespace crampon {

template <int Dim>
inline constexpr int deformation_size = Dim == 2 ? 5 : 9;

template <int Dim>
inline void initialise_deformation(Pack* F) {
  for (int c = 0; c < deformation_size<Dim>; ++c) F[c] = splat(0.);
  if constexpr (Dim == 2) {
    F[0] = F[3] = F[4] = splat(1.);
  } else {
    F[0] = F[4] = F[8] = splat(1.);
  }
}

/// F <- (I + L dt + (L dt)^2/2) F (docs/theory/kinematics.md, deformation gradient). In 2D Fzz is left to the law.
template <int Dim>
inline void advance_deformation(const Pack* L, double dt, Pack* F) {
  constexpr int n = Dim;
  Pack A[n * n], D[n * n], old[n * n];
  for (int c = 0; c < n * n; ++c) A[c] = L[c] * splat(dt), old[c] = F[c];
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      Pack square = A[i * n] * A[j];
      for (int k = 1; k < n; ++k) square = fused(A[i * n + k], A[k * n + j], square);
      D[i * n + j] = fused(splat(0.5), square, A[i * n + j]);
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      Pack sum = old[i * n + j];
      for (int k = 0; k < n; ++k) sum = fused(D[i * n + k], old[k * n + j], sum);
      F[i * n + j] = sum;
    }
  }
}

inline Pack determinant3(const Pack* F) {
  return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

template <int Dim>
inline Pack volume_ratio_of(const Pack* F) {
  if constexpr (Dim == 2) {
    return (F[0] * F[3] - F[1] * F[2]) * F[4];
  } else {
    return determinant3(F);
  }
}

/// In the plane: without the stretch of the thickness (2D).
template <int Dim>
inline Pack area_ratio_of(const Pack* F) {
  if constexpr (Dim == 2) {
    return F[0] * F[3] - F[1] * F[2];
  } else {
    return determinant3(F);
  }
}

/// b = F F^T = {xx, yy, xy, zz} or {xx, yy, zz, xy, yz, xz}.
template <int Dim>
inline void left_cauchy_green(const Pack* F, Pack* b) {
  if constexpr (Dim == 2) {
    b[0] = F[0] * F[0] + F[1] * F[1];
    b[1] = F[2] * F[2] + F[3] * F[3];
    b[2] = F[0] * F[2] + F[1] * F[3];
    b[3] = F[4] * F[4];
  } else {
    const auto row = [&](int i, int j) { return F[3 * i] * F[3 * j] + F[3 * i + 1] * F[3 * j + 1] + F[3 * i + 2] * F[3 * j + 2]; };
    b[0] = row(0, 0), b[1] = row(1, 1), b[2] = row(2, 2), b[3] = row(0, 1), b[4] = row(1, 2), b[5] = row(0, 2);
  }
}

/// Of b, in the plane (2D) or in space: a bound on the square of the longest stretch.
template <int Dim>
inline Pack largest_row_sum(const Pack* b) {
  const auto magnitude = [](Pack a) { return lane_max(a, -a); };
  if constexpr (Dim == 2) {
    return lane_max(b[0], b[1]) + magnitude(b[2]);
  } else {
    return lane_max(lane_max(b[0] + magnitude(b[3]) + magnitude(b[5]), b[1] + magnitude(b[3]) + magnitude(b[4])),
                    b[2] + magnitude(b[4]) + magnitude(b[5]));
  }
}

/// Rotation R of F = R U, row by row (docs/theory/kinematics.md, elasticity with large rotation). 2D in closed form; 3D by Higham's
/// iteration R <- (R + R^-T)/2 from F, a fixed number of times: after the first, the error squares each time, so that eight reach
/// round-off for stretches up to 10.
inline void rotation_of(const Pack* F, Pack* R, int dimension) {
  if (dimension == 2) {
    const Pack c = F[0] + F[3], s = F[2] - F[1], r = 1. / lane_sqrt(c * c + s * s);
    R[0] = c * r, R[1] = -(s * r), R[2] = s * r, R[3] = c * r;
    return;
  }
  for (int c = 0; c < 9; ++c) R[c] = F[c];
  for (int iteration = 0; iteration < 8; ++iteration) {
    const Pack half = 0.5 / determinant3(R);
    Pack T[9];  // R^-T times determinant: the cofactors
    T[0] = R[4] * R[8] - R[5] * R[7], T[1] = R[5] * R[6] - R[3] * R[8], T[2] = R[3] * R[7] - R[4] * R[6];
    T[3] = R[2] * R[7] - R[1] * R[8], T[4] = R[0] * R[8] - R[2] * R[6], T[5] = R[1] * R[6] - R[0] * R[7];
    T[6] = R[1] * R[5] - R[2] * R[4], T[7] = R[2] * R[3] - R[0] * R[5], T[8] = R[0] * R[4] - R[1] * R[3];
    for (int c = 0; c < 9; ++c) R[c] = fused(half, T[c], 0.5 * R[c]);
  }
}

}  // namespace crampon
