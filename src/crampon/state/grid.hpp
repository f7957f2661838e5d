#pragma once
/// The background grid and its division into blocks of 8 cells a side (docs/theory/space.md, blocks).

#include <array>
#include <cmath>
#include <cstdint>

#include "crampon/core/vector.hpp"

namespace crampon {

template <int Dim>
using IndexVector = std::array<int, Dim>;

constexpr int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

/// Cells along a side of a block; docs/theory/space.md (blocks) says why 8.
inline constexpr int block_side = 8;
template <int Dim>
inline constexpr int block_nodes = power(block_side, Dim);
template <int Dim>
inline constexpr int neighbour_count = power(3, Dim);

/// Uniform Cartesian grid. Node (i, j, k) stands at origin + (i, j, k) * cell, always computed by node_position, so that every
/// predicate sees the same bits. Blocks also cover one block beyond the grid on every side, for stencils that reach out.
template <int Dim>
struct Grid {
  Vec<Dim> origin;           ///< m
  Vec<Dim> cell;             ///< m
  Vec<Dim> inverse_cell;     ///< 1/m
  IndexVector<Dim> cells{};  ///< number of cells per axis
  IndexVector<Dim> blocks{};

  Grid() = default;
  Grid(const Vec<Dim>& origin_, const Vec<Dim>& cell_, const IndexVector<Dim>& cells_) : origin(origin_), cell(cell_), cells(cells_) {
    for (int k = 0; k < Dim; ++k) {
      inverse_cell[k] = 1 / cell[k];
      blocks[k] = (cells[k] + block_side) / block_side + 2;
    }
  }

  double node_coordinate(int axis, int index) const { return origin[axis] + index * cell[axis]; }
  Vec<Dim> node_position(const IndexVector<Dim>& node) const {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = node_coordinate(k, node[k]);
    return x;
  }
  bool contains(const Vec<Dim>& x) const {
    for (int k = 0; k < Dim; ++k) {
      if (!(x[k] >= origin[k] && x[k] <= node_coordinate(k, cells[k]))) return false;
    }
    return true;
  }

  /// First cell (and node) of a block.
  static int first_node(int block_coordinate) { return (block_coordinate - 1) * block_side; }
  static int block_of(int node) { return (node + block_side) / block_side; }  // node >= -block_side
  std::int64_t block_number(const IndexVector<Dim>& block) const {
    std::int64_t n = 0;
    for (int k = Dim - 1; k >= 0; --k) n = n * blocks[k] + block[k];
    return n;
  }
  IndexVector<Dim> block_coordinates(std::int64_t number) const {
    IndexVector<Dim> b{};
    for (int k = 0; k < Dim; ++k) {
      b[k] = static_cast<int>(number % blocks[k]);
      number /= blocks[k];
    }
    return b;
  }
  std::int64_t block_total() const {
    std::int64_t n = 1;
    for (int k = 0; k < Dim; ++k) n *= blocks[k];
    return n;
  }
  /// One number per node, the same for the whole run: key of what is remembered about a node.
  std::int64_t node_number(const IndexVector<Dim>& node) const {
    std::int64_t n = 0;
    for (int k = Dim - 1; k >= 0; --k) n = n * (std::int64_t{blocks[k]} * block_side) + (node[k] + block_side);
    return n;
  }
  IndexVector<Dim> node_coordinates(std::int64_t number) const {
    IndexVector<Dim> node{};
    for (int k = 0; k < Dim; ++k) {
      const std::int64_t along = std::int64_t{blocks[k]} * block_side;
      node[k] = static_cast<int>(number % along) - block_side;
      number /= along;
    }
    return node;
  }
  double smallest_cell() const {
    double h = cell[0];
    for (int k = 1; k < Dim; ++k) h = std::fmin(h, cell[k]);
    return h;
  }
  double largest_cell() const {
    double h = cell[0];
    for (int k = 1; k < Dim; ++k) h = std::fmax(h, cell[k]);
    return h;
  }
  /// Are the sides of cells equal, but for a tenth?
  bool has_even_cells() const {
    const double shortest = smallest_cell();
    for (int k = 0; k < Dim; ++k) {
      if (cell[k] > 1.1 * shortest) return false;
    }
    return true;
  }
};

/// Coordinates of local node or neighbour number n in a box of `side`^Dim.
template <int Dim>
constexpr IndexVector<Dim> unflatten(int n, int side) {
  IndexVector<Dim> i{};
  for (int k = 0; k < Dim; ++k) {
    i[k] = n % side;
    n /= side;
  }
  return i;
}

}  // namespace crampon
