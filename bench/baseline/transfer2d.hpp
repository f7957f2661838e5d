#pragma once
/// What goes between a pack of particles and the nodes of a tile, in the plane.

#include <cstring>

#include "bench/baseline/blocks.hpp"
#include "bench/baseline/weights.hpp"

namespace crampon::bench {

inline Pair low_half(Pack a) { return __builtin_shufflevector(a, a, 0, 1); }
inline Pair high_half(Pack a) { return __builtin_shufflevector(a, a, 2, 3); }
inline Pack join(Pair a, Pair b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3); }
inline Pack even_lanes(Pack a, Pack b) { return __builtin_shufflevector(a, b, 0, 4, 2, 6); }
inline Pack odd_lanes(Pack a, Pack b) { return __builtin_shufflevector(a, b, 1, 5, 3, 7); }

/// Vectors of neighbouring nodes in one load; nodes are aligned to 16 bytes only.
inline Pack load_two(const Pair* node) {
  Pack both;
  std::memcpy(&both, node, sizeof both);
  return both;
}

/// {sum a, sum b} and {sum a, sum b, sum c, sum d} over lanes, always in the same order.
inline Pair lane_sums(Pack a, Pack b) {
  const Pack h = even_lanes(a, b) + odd_lanes(a, b);
  return low_half(h) + high_half(h);
}
inline Pack lane_sums(Pack a, Pack b, Pack c, Pack d) {
  const Pack h = even_lanes(a, b) + odd_lanes(a, b), g = even_lanes(c, d) + odd_lanes(c, d);
  return __builtin_shufflevector(h, g, 0, 1, 4, 5) + __builtin_shufflevector(h, g, 2, 3, 6, 7);
}

/// Shape functions of four particles, one factor per axis. Width: nodes along an axis.
template <int Width>
struct Transfer2d {
  static constexpr int tile_side = Blocks<2, Width>::tile_side;

  Pack N_x[Width], N_y[Width], dN_x[Width], dN_y[Width];
  Base base;

  /// x, y: positions, lanes over particles, m; origin: lower end of tile index 0 among bins, in cells.
  void compute(Pack x, Pack y, const std::array<Pack, 2>& origin, double inverse_cell) {
    const Pack h = splat(inverse_cell), gx = fused(x, h, -origin[0]), gy = fused(y, h, -origin[1]), bx = lane_floor(gx),
               by = lane_floor(gy);
    base.set(fused(by, splat(tile_side), bx));
    axis_weights<Width>(gx - bx, inverse_cell, N_x, dN_x);
    axis_weights<Width>(gy - by, inverse_cell, N_y, dN_y);
  }

  /// S_ip of all nodes, lanes over particles.
  void multiply(Pack* S) const {
    for (int n = 0; n < Width * Width; ++n) S[n] = N_x[n % Width] * N_y[n / Width];
  }
  static constexpr int tile_step(int n) { return n / Width * tile_side + n % Width; }

  /// Adds S_ip {m, m v, V} to every node (N03 Eqs. 26, 27); one sum per node when the pack shares its nodes.
  void scatter(const Pack* record, Pack* tile) const {
    Pack S[Width * Width];
    multiply(S);
    if (base.same) {
      for (int n = 0; n < Width * Width; ++n) {
        Pack& q = tile[base.of[0] + tile_step(n)];
        Pack sum = q;
        for (int l = 0; l < lanes; ++l) sum = fused(splat(S[n][l]), record[l], sum);
        q = sum;
      }
    } else {
      for (int l = 0; l < lanes; ++l) {
        for (int n = 0; n < Width * Width; ++n) {
          Pack& q = tile[base.of[l] + tile_step(n)];
          q = fused(splat(S[n][l]), record[l], q);
        }
      }
    }
  }

  /// Velocity gradient {vx,x; vy,y; vx,y + vy,x}, 1/s (N03 Eq. 36).
  void gradient(const Pair* velocity, double inverse_cell, Pack* L) const {
    if constexpr (Width == 2) {
      Pack v[2][4];  // [row]{vx, vy of its first node, vx, vy of its second}, lanes over particles
      for (int j = 0; j < 2; ++j) {
        for (int l = 0; l < lanes; ++l) v[j][l] = load_two(velocity + base.of[l] + j * tile_side);
        transpose(v[j][0], v[j][1], v[j][2], v[j][3]);
      }
      const Pack h = splat(inverse_cell);
      const auto between = [](const Pack* N, Pack a, Pack b) { return fused(N[1], b, N[0] * a); };
      const Pack vx_y = between(N_x, v[1][0] - v[0][0], v[1][2] - v[0][2]), vy_x = between(N_y, v[0][3] - v[0][1], v[1][3] - v[1][1]);
      L[0] = h * between(N_y, v[0][2] - v[0][0], v[1][2] - v[1][0]);
      L[1] = h * between(N_x, v[1][1] - v[0][1], v[1][3] - v[0][3]);
      L[2] = h * (vy_x + vx_y);
    } else {
      L[0] = L[1] = L[2] = splat(0.);
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) {
        const Pair* row = velocity + j * tile_side;
        Pack v[4];
        for (int l = 0; l < lanes; ++l) v[l] = load_two(row + base.of[l]);
        transpose(v[0], v[1], v[2], v[3]);
        const Pack a = join(row[base.of[0] + 2], row[base.of[2] + 2]), b = join(row[base.of[1] + 2], row[base.of[3] + 2]);
        const Pack vx[3] = {v[0], v[2], even_lanes(a, b)}, vy[3] = {v[1], v[3], odd_lanes(a, b)};
        const auto sum = [](const Pack* N, const Pack* q) { return fused(N[0], q[0], fused(N[1], q[1], N[2] * q[2])); };
        L[0] = fused(N_y[j], sum(dN_x, vx), L[0]);
        L[1] = fused(dN_y[j], sum(N_x, vy), L[1]);
        L[2] = fused(N_y[j], sum(dN_x, vy), fused(dN_y[j], sum(N_x, vx), L[2]));
      }
    }
  }

  /// Adds -V sigma . G_ip to every node (N03 Eq. 28). xx, yy, xy: -V sigma, N m; by h for linear functions, whose G is then -1, 1.
  void scatter_force(Pack xx, Pack yy, Pack xy, Pair* tile) const {
#pragma GCC unroll 3
    for (int j = 0; j < Width; ++j) {
      Pair* row = tile + j * tile_side;
      Pack f[2 * Width];  // {fx, fy} of each node of the row, lanes over particles
      if constexpr (Width == 2) {
        const Pack a = xx * N_y[j], b = xy * N_y[j], c = j == 0 ? -xy : xy, d = j == 0 ? -yy : yy;
        f[0] = fused(c, N_x[0], -a), f[1] = fused(d, N_x[0], -b), f[2] = fused(c, N_x[1], a), f[3] = fused(d, N_x[1], b);
      } else {
        const Pack a = xx * N_y[j], b = xy * dN_y[j], c = xy * N_y[j], d = yy * dN_y[j];
        for (int i = 0; i < 3; ++i) f[2 * i] = fused(dN_x[i], a, N_x[i] * b), f[2 * i + 1] = fused(dN_x[i], c, N_x[i] * d);
      }
      // In halves: the next pack's loads of single nodes can take them from the store under way.
      if (base.same) {
        Pair* q = row + base.of[0];
        const Pack sum = lane_sums(f[0], f[1], f[2], f[3]);
        q[0] += low_half(sum), q[1] += high_half(sum);
        if constexpr (Width == 3) q[2] += lane_sums(f[4], f[5]);
      } else {
        transpose(f[0], f[1], f[2], f[3]);
        for (int l = 0; l < lanes; ++l) {
          Pair* q = row + base.of[l];
          q[0] += low_half(f[l]), q[1] += high_half(f[l]);
        }
        if constexpr (Width == 3) {
          const Pack e = even_lanes(f[4], f[5]), o = odd_lanes(f[4], f[5]);
          row[base.of[0] + 2] += low_half(e), row[base.of[1] + 2] += low_half(o);
          row[base.of[2] + 2] += high_half(e), row[base.of[3] + 2] += high_half(o);
        }
      }
    }
  }

  /// {v', a} at each particle of a pack: sum of S_ip {v'_i, a_i}.
  void interpolate(const Pack* nodes, Pack* motion) const {
    Pack S[Width * Width];
    multiply(S);
    for (int l = 0; l < lanes; ++l) {
      const Pack* q = nodes + base.of[l];
      Pack sum[2] = {splat(0.), splat(0.)};  // two chains
#pragma GCC unroll 9
      for (int n = 0; n < Width * Width; ++n) sum[n & 1] = fused(splat(S[n][l]), q[tile_step(n)], sum[n & 1]);
      motion[l] = sum[0] + sum[1];
    }
  }
};

}  // namespace crampon::bench
