#pragma once
/// S_ip and G_ip (N03 Eq. 24) of four particles at all nodes of their stencils.

#include <array>

#include "crampon/core/pack.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/state/grid.hpp"

namespace crampon {

/// A tile: the nodes a block's particles can reach, with one cell of drift on every side (DESIGN section 2).
template <int Dim, class Shape>
struct Tile {
  static constexpr int drift = 1;
  /// Tile index of the block's first node.
  static constexpr int offset = drift + (Shape::width == 3 ? 1 : 0);
  static constexpr int side = block_side + (Shape::width == 2 ? 1 : 2) + 2 * drift;
  static constexpr int nodes = power(side, Dim);
  static constexpr int stencil = power(Shape::width, Dim);

  /// Tile index of stencil node n relative to the stencil's lowest node.
  static constexpr std::array<int, stencil> make_steps() {
    std::array<int, stencil> out{};
    for (int n = 0; n < stencil; ++n) {
      int rest = n, stride = 1;
      for (int k = 0; k < Dim; ++k) {
        out[n] += rest % Shape::width * stride;
        rest /= Shape::width;
        stride *= side;
      }
    }
    return out;
  }
  static constexpr std::array<int, stencil> steps = make_steps();
};

/// Half edges of an undeformed particle in cells, per axis.
template <int Dim>
using HalfSize = std::array<double, Dim>;

template <int Dim, class Shape>
struct Stencil {
  static constexpr int count = Tile<Dim, Shape>::stencil;
  Pack S[count];                ///< lanes over particles
  Pack G[count][Dim];           ///< 1/m
  alignas(32) int base[lanes];  ///< index of the lowest node in the tile's layers: layer * nodes + tile index
  bool same_base;               ///< all four particles share it
  int layer = 0;                ///< of pairs that cross nothing

  /// Tile index of the lowest node of lane l.
  int lowest(int l) const { return base[l] - layer * Tile<Dim, Shape>::nodes; }
  /// After compute().
  void move_to_layer(int to) {
    layer = to;
    for (int& b : base) b += to * Tile<Dim, Shape>::nodes;
  }

  /// x: positions, one Pack per axis, m; first_node: grid index of the block's first node.
  void compute(const Pack* x, const Grid<Dim>& grid, const IndexVector<Dim>& first_node, const HalfSize<Dim>& half_size) {
    using T = Tile<Dim, Shape>;
    layer = 0;
    Pack N[Dim][Shape::width], dN[Dim][Shape::width];
    Pack index = splat(0.);
    double stride = 1;
    for (int k = 0; k < Dim; ++k) {
      const Pack g = (x[k] - grid.origin[k]) * grid.inverse_cell[k] + Shape::bin_shift;
      const Pack bin = lane_floor(g);
      Shape::weights(g - bin, half_size[k], grid.inverse_cell[k], N[k], dN[k]);
      // bin: cell (width 2) or nearest node (width 3); the lowest node is one below the nearest.
      const double lowest = T::offset - first_node[k] - (Shape::width == 3 ? 1 : 0);
      index = fused(bin + lowest, splat(stride), index);
      stride *= T::side;
    }
    for (int l = 0; l < lanes; ++l) base[l] = static_cast<int>(index[l]);
    same_base = base[0] == base[1] && base[0] == base[2] && base[0] == base[3];
    for (int n = 0; n < count; ++n) {
      const auto i = unflatten<Dim>(n, Shape::width);
      if constexpr (Dim == 2) {
        S[n] = N[0][i[0]] * N[1][i[1]];
        G[n][0] = dN[0][i[0]] * N[1][i[1]];
        G[n][1] = N[0][i[0]] * dN[1][i[1]];
      } else {
        const Pack xy = N[0][i[0]] * N[1][i[1]];
        S[n] = xy * N[2][i[2]];
        G[n][0] = dN[0][i[0]] * N[1][i[1]] * N[2][i[2]];
        G[n][1] = N[0][i[0]] * dN[1][i[1]] * N[2][i[2]];
        G[n][2] = xy * dN[2][i[2]];
      }
    }
  }
};

}  // namespace crampon
