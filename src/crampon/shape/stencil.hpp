#pragma once
/// S_ip and G_ip (N03 Eq. 24) of four particles at all nodes of their stencils.

#include <array>
#include <cmath>
#include <type_traits>

#include "crampon/core/pack.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/shape/domain.hpp"
#include "crampon/shape/profile.hpp"
#include "crampon/state/grid.hpp"

namespace crampon {

/// A tile: the nodes a block's particles can reach, with one cell of drift on every side (docs/theory/space.md, tiles).
template <int Dim, class Shape>
struct Tile {
  static constexpr int drift = 1;
  /// Tile index of the block's first node.
  static constexpr int offset = drift + Shape::below;
  static constexpr int side = block_side + Shape::width - 1 + 2 * drift;
  static_assert(offset <= block_side && side - offset <= 2 * block_side,
                "a tile must end within the blocks next to its own (step/assemble.hpp)");
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

  explicit NodeWeights(const AxisFactors<Dim, Width>& f) {
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
  explicit NodeWeights(const CornerFactors& f) {
    for (int n = 0; n < count; ++n) {
      const auto i = unflatten<Dim>(n, Width);
      S[n] = G[n][0] = G[n][1] = splat(0.);
      for (int c = 0; c < CornerFactors::count; ++c) {
        const Pack at_corner = f.N[c][0][i[0]] * f.N[c][1][i[1]];
        S[n] = fused(splat(1. / CornerFactors::count), at_corner, S[n]);
        for (int k = 0; k < 2; ++k) G[n][k] = fused(f.slope[c][k], at_corner, G[n][k]);
      }
    }
  }
};

/// Where the stencils of four particles lie, and the factors of their S_ip and G_ip.
template <int Dim, class Shape>
struct StencilFactors {
  /// Domains that shear are parallelograms in the plane; in space they are boxes (docs/decisions/0019-domains-that-stretch.md).
  static constexpr bool has_corners = Shape::has_domains && Dim == 2;

  std::conditional_t<has_corners, CornerFactors, AxisFactors<Dim, Shape::width>> factors;
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

  /// S_ip of lane l at stencil node n.
  double weight(int n, int l) const { return product(n, l, -1); }
  /// G_ip of lane l at stencil node n along axis k, 1/m.
  double slope(int n, int k, int l) const { return product(n, l, k); }

  /// x: positions, one Pack per axis, m; first_node: grid index of the block's first node.
  void compute(const Pack* x, const Grid<Dim>& grid, const IndexVector<Dim>& first_node,
               const HalfSize<Dim>& half_size) requires(!Shape::has_domains) {
    Pack f[Dim];
    place(x, grid, first_node, f);
    for (int k = 0; k < Dim; ++k) Shape::weights(f[k], half_size[k], grid.inverse_cell[k], factors.N[k], factors.dN[k]);
  }
  /// The same for domains that have moved with the nodes.
  void compute(const Pack* x, const Grid<Dim>& grid, const IndexVector<Dim>& first_node,
               const DomainEdges<Dim>& edges) requires Shape::has_domains {
    Pack d[Dim];
    place(x, grid, first_node, d);
    for (int k = 0; k < Dim; ++k) d[k] = d[k] - Shape::bin_shift;
    if constexpr (has_corners) {
      factors.compute(d, edges, grid.inverse_cell);
    } else {
      for (int k = 0; k < Dim; ++k) {
        Pack square = splat(0.);
        for (int j = 0; j < Dim; ++j) square = fused(edges.r[k][j], edges.r[k][j], square);
        box_factors(d[k], lane_sqrt(square), grid.inverse_cell[k], factors.N[k], factors.dN[k]);
      }
    }
  }

 private:
  /// Finds the nodes; f: where particles are in their bins, in cells.
  [[gnu::always_inline]] inline void place(const Pack* x, const Grid<Dim>& grid, const IndexVector<Dim>& first_node, Pack* f) {
    using T = Tile<Dim, Shape>;
    layer = 0;
    Pack index = splat(0.);
    double stride = 1;
    for (int k = 0; k < Dim; ++k) {
      const Pack g = (x[k] - grid.origin[k]) * grid.inverse_cell[k] + Shape::bin_shift;
      const Pack bin = lane_floor(g);
      f[k] = g - bin;
      const double lowest = T::offset - first_node[k] - Shape::below;
      index = fused(bin + lowest, splat(stride), index);
      stride *= T::side;
    }
    for (int l = 0; l < lanes; ++l) base[l] = static_cast<int>(index[l]);
    same_base = base[0] == base[1] && base[0] == base[2] && base[0] == base[3];
  }

  /// The factors of lane l at node n, with the derivative along one axis or none.
  double product(int n, int l, int derived) const {
    const auto i = unflatten<Dim>(n, Shape::width);
    if constexpr (has_corners) {
      double sum = 0;
      for (int c = 0; c < CornerFactors::count; ++c) {
        const double by = derived < 0 ? 1. / CornerFactors::count : factors.slope[c][derived][l];
        sum = std::fma(by, factors.N[c][0][i[0]][l] * factors.N[c][1][i[1]][l], sum);
      }
      return sum;
    } else {
      double value = (derived == 0 ? factors.dN : factors.N)[0][i[0]][l];
      for (int k = 1; k < Dim; ++k) value *= (derived == k ? factors.dN : factors.N)[k][i[k]][l];
      return value;
    }
  }
};

/// The same with S_ip and G_ip ready for every node. Refers to the factors.
template <int Dim, class Shape>
struct Stencil {
  using Factors = StencilFactors<Dim, Shape>;
  static constexpr int count = Tile<Dim, Shape>::stencil;
  /// In space sums go axis by axis (shape/separable.hpp), and products for each node are not formed.
  static constexpr bool separable = Dim == 3;
  struct Nothing {
    explicit Nothing(const AxisFactors<Dim, Shape::width>&) {}
  };
  const Factors& of;
  [[no_unique_address]] std::conditional_t<separable, Nothing, NodeWeights<Dim, Shape::width>> weights;

  explicit Stencil(const Factors& f) : of(f), weights(f.factors) {}

  double weight(int n, int l) const {
    if constexpr (separable) {
      return of.weight(n, l);
    } else {
      return weights.S[n][l];
    }
  }
  double slope(int n, int k, int l) const {
    if constexpr (separable) {
      return of.slope(n, k, l);
    } else {
      return weights.G[n][k][l];
    }
  }
};

}  // namespace crampon
