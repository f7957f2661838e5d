#pragma once
/// What goes between a pack of particles and the nodes of a tile in three dimensions, as separable sums.

#include "bench/baseline/blocks.hpp"
#include "bench/baseline/weights.hpp"

namespace crampon::bench {

/// Shape functions of four particles, one factor per axis. Width: nodes along an axis.
template <int Width>
struct Transfer3d {
  static constexpr int plane = Width * Width;  ///< stencil nodes of one z

  Pack N[3][Width], dN[3][Width];
  Base base;

  static constexpr int tile_node(int i, int j, int k) { return Blocks<3, Width>::tile_node(i, j, k); }

  /// x: positions, one pack per axis, lanes over particles, m; origin: lower end of tile index 0 among bins, in cells.
  void compute(const Pack* x, const std::array<Pack, 3>& origin, double inverse_cell) {
    Pack bin[3];
    for (int d = 0; d < 3; ++d) {
      const Pack g = fused(x[d], splat(inverse_cell), -origin[d]);
      bin[d] = lane_floor(g);
      axis_weights<Width>(g - bin[d], inverse_cell, N[d], dN[d]);
    }
    base.set(fused(fused(bin[2], splat(Blocks<3, Width>::tile_side), bin[1]), splat(Blocks<3, Width>::tile_side), bin[0]));
  }

  /// dN times a at node n of an axis, lane l, and the same added to a sum. dN of linear functions is -1 and 1 here; 1/h comes in at the end.
  Pack slope_times(int axis, int n, int l, Pack a) const {
    if constexpr (Width == 2) {
      return n == 0 ? -a : a;
    } else {
      return broadcast(dN[axis][n], l) * a;
    }
  }
  Pack plus_slope_times(int axis, int n, int l, Pack a, Pack sum) const {
    if constexpr (Width == 2) {
      return n == 0 ? sum - a : sum + a;
    } else {
      return fused(broadcast(dN[axis][n], l), a, sum);
    }
  }

  /// Adds S_ip m {1, v} of particles [l0, l1) of a pack, which share their nodes, to every node (N03 Eq. 26).
  void scatter(const Pack* record, int l0, int l1, Pack* tile) const {
    Pack* lowest = tile + base.of[l0];
    Pack along_x[lanes][Width], N_yz[Width][Width];
    for (int l = l0; l < l1; ++l) {
      for (int i = 0; i < Width; ++i) along_x[l][i] = broadcast(N[0][i], l) * record[l];
    }
    for (int n = 0; n < plane; ++n) N_yz[n / Width][n % Width] = N[1][n % Width] * N[2][n / Width];
#pragma GCC unroll 3
    for (int k = 0; k < Width; ++k) {
      Pack sum[plane];
#pragma GCC unroll 9
      for (int n = 0; n < plane; ++n) sum[n] = lowest[tile_node(n % Width, n / Width, k)];
      for (int l = l0; l < l1; ++l) {
#pragma GCC unroll 9
        for (int n = 0; n < plane; ++n) sum[n] = fused(broadcast(N_yz[k][n / Width], l), along_x[l][n % Width], sum[n]);
      }
#pragma GCC unroll 9
      for (int n = 0; n < plane; ++n) lowest[tile_node(n % Width, n / Width, k)] = sum[n];
    }
  }

  /// g[d]: sum of {0, v_i} G_ip,d for lane l, 1/s (N03 Eq. 36); by h for linear functions.
  void gradient(const Pack* velocity, int l, Pack* g) const {
    const Pack* lowest = velocity + base.of[l];
#pragma GCC unroll 3
    for (int k = 0; k < Width; ++k) {
      Pack v_xy, v_xy_x, v_xy_y;  // summed along x and y: values and slopes
#pragma GCC unroll 3
      for (int j = 0; j < Width; ++j) {
        Pack v_x, v_x_x;  // summed along x
#pragma GCC unroll 3
        for (int i = 0; i < Width; ++i) {
          const Pack v_i = lowest[tile_node(i, j, k)], N_x = broadcast(N[0][i], l);
          v_x = i == 0 ? N_x * v_i : fused(N_x, v_i, v_x);
          v_x_x = i == 0 ? slope_times(0, i, l, v_i) : plus_slope_times(0, i, l, v_i, v_x_x);
        }
        const Pack N_y = broadcast(N[1][j], l);
        v_xy = j == 0 ? N_y * v_x : fused(N_y, v_x, v_xy);
        v_xy_x = j == 0 ? N_y * v_x_x : fused(N_y, v_x_x, v_xy_x);
        v_xy_y = j == 0 ? slope_times(1, j, l, v_x) : plus_slope_times(1, j, l, v_x, v_xy_y);
      }
      const Pack N_z = broadcast(N[2][k], l);
      g[0] = k == 0 ? N_z * v_xy_x : fused(N_z, v_xy_x, g[0]);
      g[1] = k == 0 ? N_z * v_xy_y : fused(N_z, v_xy_y, g[1]);
      g[2] = k == 0 ? slope_times(2, k, l, v_xy) : plus_slope_times(2, k, l, v_xy, g[2]);
    }
  }

  /// Adds {0, -V sigma . G_ip} of particles [l0, l1) of a pack, which share their nodes, to every node (N03 Eq. 28). t[d]: row d of -V sigma
  /// of each particle, N m; by 1/h for linear functions.
  void scatter_force(const Pack (*t)[lanes], int l0, int l1, Pack* tile) const {
    Pack* lowest = tile + base.of[l0];
#pragma GCC unroll 3
    for (int k = 0; k < Width; ++k) {
      Pack sum[plane];
#pragma GCC unroll 9
      for (int n = 0; n < plane; ++n) sum[n] = lowest[tile_node(n % Width, n / Width, k)];
      for (int l = l0; l < l1; ++l) {
        const Pack N_z = broadcast(N[2][k], l), x = N_z * t[0][l], y = N_z * t[1][l], z = slope_times(2, k, l, t[2][l]);
#pragma GCC unroll 3
        for (int j = 0; j < Width; ++j) {
          const Pack N_y = broadcast(N[1][j], l), slope = N_y * x, value = fused(N_y, z, slope_times(1, j, l, y));
#pragma GCC unroll 3
          for (int i = 0; i < Width; ++i) {
            Pack& f = sum[j * Width + i];
            f = fused(broadcast(N[0][i], l), value, f);
            if constexpr (Width == 2) {
              f = fused(i == 0 ? -N_y : N_y, x, f);  // slope is never formed
            } else {
              f = fused(broadcast(dN[0][i], l), slope, f);
            }
          }
        }
      }
#pragma GCC unroll 9
      for (int n = 0; n < plane; ++n) lowest[tile_node(n % Width, n / Width, k)] = sum[n];
    }
  }

  /// Sum of S_ip times the nodes' values at lane l.
  Pack interpolate(int l, const Pack* nodes) const {
    const Pack* lowest = nodes + base.of[l];
    Pack q_xyz;
#pragma GCC unroll 3
    for (int k = 0; k < Width; ++k) {
      Pack q_xy;
#pragma GCC unroll 3
      for (int j = 0; j < Width; ++j) {
        Pack q_x = broadcast(N[0][0], l) * lowest[tile_node(0, j, k)];
        for (int i = 1; i < Width; ++i) q_x = fused(broadcast(N[0][i], l), lowest[tile_node(i, j, k)], q_x);
        const Pack N_y = broadcast(N[1][j], l);
        q_xy = j == 0 ? N_y * q_x : fused(N_y, q_x, q_xy);
      }
      const Pack N_z = broadcast(N[2][k], l);
      q_xyz = k == 0 ? N_z * q_xy : fused(N_z, q_xy, q_xyz);
    }
    return q_xyz;
  }
};

}  // namespace crampon::bench
