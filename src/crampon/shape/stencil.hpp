#pragma once
/// S_ip and G_ip (N03 Eq. 24) of four particles at all nodes of their stencils.

#include <array>
#include <type_traits>

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

/// Factors of S_ip and G_ip, one per axis; lanes over particles.
template <int Dim, int Width>
struct AxisFactors {
  Pack N[Dim][Width];
  Pack dN[Dim][Width];  ///< 1/m
};

/// S_ip and G_ip for each node; lanes over particles.
template <int Dim, int Width>
struct NodeWeights {
  static constexpr int count = power(Width, Dim);
  Pack S[count];
  Pack G[count][Dim];  ///< 1/m

  void multiply(const AxisFactors<Dim, Width>& f) {
    for (int n = 0; n < count; ++n) {
      const auto i = unflatten<Dim>(n, Width);
      if constexpr (Dim == 2) {
        S[n] = f.N[0][i[0]] * f.N[1][i[1]];
        G[n][0] = f.dN[0][i[0]] * f.N[1][i[1]];
        G[n][1] = f.N[0][i[0]] * f.dN[1][i[1]];
      } else {
        const Pack xy = f.N[0][i[0]] * f.N[1][i[1]];
        S[n] = xy * f.N[2][i[2]];
        G[n][0] = f.dN[0][i[0]] * f.N[1][i[1]] * f.N[2][i[2]];
        G[n][1] = f.N[0][i[0]] * f.dN[1][i[1]] * f.N[2][i[2]];
        G[n][2] = xy * f.dN[2][i[2]];
      }
    }
  }
};

template <int Dim, class Shape>
struct Stencil {
  static constexpr int count = Tile<Dim, Shape>::stencil;
  /// With 27 nodes, sums go axis by axis (shape/separable.hpp) and products for each node are not formed.
  static constexpr bool separable = Dim == 3 && Shape::width == 3;
  std::conditional_t<separable, AxisFactors<Dim, Shape::width>, NodeWeights<Dim, Shape::width>> weights;
  alignas(32) int base[lanes];  ///< index of the lowest node in the tile's layers: layer * nodes + tile index
  bool same_base;               ///< all four particles share it
  int layer = 0;                ///< of pairs that cross nothing

  /// S_ip of lane l at stencil node n.
  double weight(int n, int l) const {
    if constexpr (separable) {
      const auto i = unflatten<Dim>(n, Shape::width);
      return weights.N[0][i[0]][l] * weights.N[1][i[1]][l] * weights.N[2][i[2]][l];
    } else {
      return weights.S[n][l];
    }
  }
  /// G_ip of lane l at stencil node n along axis k, 1/m.
  double slope(int n, int k, int l) const {
    if constexpr (separable) {
      const auto i = unflatten<Dim>(n, Shape::width);
      double product = 1;
      for (int d = 0; d < Dim; ++d) product *= (d == k ? weights.dN : weights.N)[d][i[d]][l];
      return product;
    } else {
      return weights.G[n][k][l];
    }
  }

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
    AxisFactors<Dim, Shape::width> f;
    Pack index = splat(0.);
    double stride = 1;
    for (int k = 0; k < Dim; ++k) {
      const Pack g = (x[k] - grid.origin[k]) * grid.inverse_cell[k] + Shape::bin_shift;
      const Pack bin = lane_floor(g);
      Shape::weights(g - bin, half_size[k], grid.inverse_cell[k], f.N[k], f.dN[k]);
      // bin: cell (width 2) or nearest node (width 3); the lowest node is one below the nearest.
      const double lowest = T::offset - first_node[k] - (Shape::width == 3 ? 1 : 0);
      index = fused(bin + lowest, splat(stride), index);
      stride *= T::side;
    }
    for (int l = 0; l < lanes; ++l) base[l] = static_cast<int>(index[l]);
    same_base = base[0] == base[1] && base[0] == base[2] && base[0] == base[3];
    if constexpr (separable) {
      weights = f;
    } else {
      weights.multiply(f);
    }
  }
};

}  // namespace crampon
