#pragma once
/// Sums over the nodes of a stencil in space, axis by axis: S_ip = N_x N_y N_z (N03 Eq. 24). A node costs one or two operations, its weights
/// none, and the factors of a particle stay in the first-level cache. Scatters keep a plane of nodes in registers over particles that share it.

#include "crampon/shape/stencil.hpp"

namespace crampon {

template <class Shape>
class SeparableSums {
  using T = Tile<3, Shape>;
  static constexpr int width = Shape::width, plane = width * width;
  static_assert(width <= 4, "the loops below are unrolled up to four times, and in a plane up to sixteen times");

 public:
  explicit SeparableSums(const Stencil<3, Shape>& s) : s_(s) {}

  /// Adds S_ip * record of lanes [l0, l1), which share their nodes, to every node.
  void scatter(int l0, int l1, const Pack* record, Pack* tiles) const {
    Pack* lowest = tiles + s_.of.base[l0];
    for (int k = 0; k < width; ++k) {
      Pack sum[plane];
      read(lowest, k, sum);
      for (int l = l0; l < l1; ++l) {
        const Pack by_z = factor(2, k, l) * record[l];
#pragma GCC unroll 4
        for (int j = 0; j < width; ++j) {
          const Pack by_yz = factor(1, j, l) * by_z;
#pragma GCC unroll 4
          for (int i = 0; i < width; ++i) sum[j * width + i] = fused(factor(0, i, l), by_yz, sum[j * width + i]);
        }
      }
      write(sum, k, lowest);
    }
  }

  /// Adds sum_k t[k] G_ip,k of lane l to every node.
  void scatter_slopes(int l, const Pack* t, Pack* tiles) const {
    Pack* lowest = tiles + s_.of.base[l];
    for (int k = 0; k < width; ++k) {
      const Pack x = factor(2, k, l) * t[0], y = factor(2, k, l) * t[1], z = slope_factor(2, k, l) * t[2];
#pragma GCC unroll 4
      for (int j = 0; j < width; ++j) {
        const Pack slope = factor(1, j, l) * x, value = fused(factor(1, j, l), z, slope_factor(1, j, l) * y);
#pragma GCC unroll 4
        for (int i = 0; i < width; ++i) {
          Pack& f = lowest[step(i, j, k)];
          f = fused(slope_factor(0, i, l), slope, fused(factor(0, i, l), value, f));
        }
      }
    }
  }

  /// Adds sum_k t_ck G_ip,k of all lanes, which share their nodes, to component c of every node; lanes over particles. t: xx, yy, zz, xy, yz, xz.
  void scatter_slopes(const Pack* t, Pack* tiles) const {
    const auto &N = s_.of.factors.N, &dN = s_.of.factors.dN;
    Pack* lowest = tiles + s_.of.base[0];
#pragma GCC unroll 4
    for (int k = 0; k < width; ++k) {
#pragma GCC unroll 4
      for (int j = 0; j < width; ++j) {
        const Pack yz = N[1][j] * N[2][k], y_slope = dN[1][j] * N[2][k], z_slope = N[1][j] * dN[2][k];
        const auto across = [&](int y, int z) { return fused(t[y], y_slope, t[z] * z_slope); };
        const Pack along[3] = {t[0] * yz, t[3] * yz, t[5] * yz}, rest[3] = {across(3, 5), across(1, 4), across(4, 2)};
#pragma GCC unroll 4
        for (int i = 0; i < width; ++i) {
          const auto sum = [&](int c) { return fused(dN[0][i], along[c], N[0][i] * rest[c]); };
          lowest[step(i, j, k)] += lane_sums(sum(0), sum(1), sum(2));
        }
      }
    }
  }

  /// Sum over the nodes of S_ip times value(node), at lane l.
  template <class Value>
  Pack interpolate(int l, Value value) const {
    Pack of_space = splat(0.);
#pragma GCC unroll 4
    for (int k = 0; k < width; ++k) {
      Pack of_plane = splat(0.);
#pragma GCC unroll 4
      for (int j = 0; j < width; ++j) {
        Pack of_row = factor(0, 0, l) * value(step(0, j, k));
#pragma GCC unroll 4
        for (int i = 1; i < width; ++i) of_row = fused(factor(0, i, l), value(step(i, j, k)), of_row);
        of_plane = j == 0 ? factor(1, j, l) * of_row : fused(factor(1, j, l), of_row, of_plane);
      }
      of_space = k == 0 ? factor(2, k, l) * of_plane : fused(factor(2, k, l), of_plane, of_space);
    }
    return of_space;
  }

  /// g[k]: sum over the nodes of G_ip,k times value(node), at lane l.
  template <class Value>
  void gradient(int l, Value value, Pack* g) const {
    slopes_of([&](int axis, int n) { return factor(axis, n, l); }, [&](int axis, int n) { return slope_factor(axis, n, l); }, value, g);
  }
  /// The same in every lane, for lanes that share their nodes.
  template <class Value>
  void gradient(Value value, Pack* g) const {
    slopes_of([&](int axis, int n) { return s_.of.factors.N[axis][n]; }, [&](int axis, int n) { return s_.of.factors.dN[axis][n]; }, value,
              g);
  }

 private:
  static constexpr int step(int i, int j, int k) { return (k * T::side + j) * T::side + i; }
  Pack factor(int axis, int n, int l) const { return splat_lane(s_.of.factors.N[axis][n], l); }
  Pack slope_factor(int axis, int n, int l) const { return splat_lane(s_.of.factors.dN[axis][n], l); }

  template <class Factor, class Slope, class Value>
  static void slopes_of(Factor N, Slope dN, Value value, Pack* g) {
#pragma GCC unroll 4
    for (int k = 0; k < width; ++k) {
      Pack of_plane = splat(0.), slope_x = of_plane, slope_y = of_plane;
#pragma GCC unroll 4
      for (int j = 0; j < width; ++j) {
        Pack of_row = splat(0.), slope = of_row;
#pragma GCC unroll 4
        for (int i = 0; i < width; ++i) {
          const Pack v = value(step(i, j, k));
          of_row = i == 0 ? N(0, i) * v : fused(N(0, i), v, of_row);
          slope = i == 0 ? dN(0, i) * v : fused(dN(0, i), v, slope);
        }
        of_plane = j == 0 ? N(1, j) * of_row : fused(N(1, j), of_row, of_plane);
        slope_x = j == 0 ? N(1, j) * slope : fused(N(1, j), slope, slope_x);
        slope_y = j == 0 ? dN(1, j) * of_row : fused(dN(1, j), of_row, slope_y);
      }
      g[0] = k == 0 ? N(2, k) * slope_x : fused(N(2, k), slope_x, g[0]);
      g[1] = k == 0 ? N(2, k) * slope_y : fused(N(2, k), slope_y, g[1]);
      g[2] = k == 0 ? dN(2, k) * of_plane : fused(dN(2, k), of_plane, g[2]);
    }
  }

  static void read(const Pack* lowest, int k, Pack* sum) {
#pragma GCC unroll 16
    for (int n = 0; n < plane; ++n) sum[n] = lowest[step(n % width, n / width, k)];
  }
  static void write(const Pack* sum, int k, Pack* lowest) {
#pragma GCC unroll 16
    for (int n = 0; n < plane; ++n) lowest[step(n % width, n / width, k)] = sum[n];
  }

  const Stencil<3, Shape>& s_;
};

}  // namespace crampon
