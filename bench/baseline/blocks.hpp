#pragma once
/// Blocks of cells with their particles, and what passes between the nodes of blocks and private tiles.
///
/// Particles are ordered by block and base node, in packs of four; a block's packs are filled up with particles without mass. A block's
/// particles work on a tile: the block's nodes and those around it that a stencil can reach. Of a tile, only the box of nodes that particles
/// touch is cleared, gathered and assembled; the update of positions finds the box for the next step, and with it who has drifted too far.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "crampon/core/aligned_array.hpp"
#include "crampon/core/pack.hpp"

namespace crampon::bench {

using Index3 = std::array<int, 3>;

inline constexpr int side = 8;    ///< cells along a block
inline constexpr int margin = 1;  ///< cells that a particle may drift out of its block

/// Width: nodes of a stencil along an axis, 2 around the cell or 3 around the nearest node. Bins are cells, or cells around nodes.
template <int Dim, int Width>
class Blocks {
 public:
  static constexpr int along_z(int n) { return Dim == 3 ? n : 1; }
  static constexpr int offset = margin + Width - 2;                ///< tile index of the block's first node, per axis
  static constexpr int tile_side = side + Width - 1 + 2 * margin;  ///< nodes
  static constexpr int tile_nodes = tile_side * tile_side * along_z(tile_side);
  static constexpr int block_nodes = side * side * along_z(side);
  static constexpr double bin_shift = Width == 3 ? .5 : 0.;
  static constexpr int tile_node(int i, int j, int k = 0) { return (k * tile_side + j) * tile_side + i; }

  struct Particle {
    int bin;                  ///< counted block by block
    std::array<double, 3> x;  ///< cells
    double V;                 ///< of the cell; 0: padding
  };

  explicit Blocks(int cells) : along_((cells + 2) / side + 2), box_(static_cast<std::size_t>(along_ * along_ * along_z(along_))) {}

  int count() const { return static_cast<int>(box_.size()); }
  bool has_particles(int b) const { return first_pack_[b + 1] > first_pack_[b]; }
  std::size_t first_pack(int b) const { return first_pack_[b]; }

  /// All particles of a block of so many cells along each side, in their order, padding among them.
  std::vector<Particle> place_particles(int cells) {
    std::vector<Particle> list;
    for (int k = 0; k < along_z(2 * cells); ++k) {
      for (int j = 0; j < 2 * cells; ++j) {
        for (int i = 0; i < 2 * cells; ++i) list.push_back(particle({i, j, k}));
      }
    }
    std::stable_sort(list.begin(), list.end(), [](const Particle& a, const Particle& b) { return a.bin < b.bin; });

    std::vector<Particle> padded;
    auto next = list.begin();
    first_pack_ = {0};
    for (int b = 0; b < count(); ++b) {
      Pack low = splat(1e300), high = -low;
      for (; next != list.end() && next->bin / block_nodes == b; ++next) {
        padded.push_back(*next);
        const Pack x = positions(next->x);
        low = lane_min(low, x), high = lane_max(high, x);
      }
      while (padded.size() % lanes != 0) padded.push_back(padded.back()), padded.back().V = 0;
      first_pack_.push_back(padded.size() / lanes);
      if (has_particles(b)) find_box(b, low, high, 1);
    }
    return padded;
  }

  /// In cells: the lower end of tile index 0 of a block among bins, along each axis.
  std::array<Pack, Dim> tile_origin(int b) const {
    std::array<Pack, Dim> origin;
    for (int d = 0; d < Dim; ++d) origin[d] = splat(coordinates(b)[d] * side - margin - bin_shift);
    return origin;
  }

  /// Finds the box of tile nodes in reach; false when it does not fit. low, high: extreme positions of a block's particles, {x, y, ., .} or
  /// {., x, y, z}, m.
  bool find_box(int b, Pack low, Pack high, double inverse_cell) {
    Box box{{0, 0, 0}, {1, 1, 1}};
    bool fits = true;
    const auto origin = tile_origin(b);
    for (int d = 0; d < Dim; ++d) {
      const auto bin = [&](Pack x) { return static_cast<int>(std::floor(x[Dim - 2 + d] * inverse_cell - origin[d][0])); };
      const int from = bin(low), to = bin(high) + Width;
      fits = fits && from >= 0 && to <= tile_side;
      box.low[d] = std::max(from, 0), box.high[d] = std::min(to, tile_side);
    }
    box_[b] = box;
    return fits;
  }

  template <class Record>
  Record* cleared_tile(AlignedArray<Record>& tiles, int b) const {
    Record* tile = &tiles[std::size_t{tile_nodes} * b];
    const Box box = box_[b];
    for (int k = box.low[2]; k < box.high[2]; ++k) {
      for (int j = box.low[1]; j < box.high[1]; ++j) {
        for_row(box.low[0], box.high[0], [&](int i) { tile[tile_node(i, j, k)] = Record{}; });
      }
    }
    return tile;
  }

  /// Sum of all tiles over the own nodes of a block, always in the same order.
  template <class Record>
  void assemble(const AlignedArray<Record>& tiles, int b, Record* sum) const {
    std::fill(sum, sum + block_nodes, Record{});
    for_neighbours(b, [&](int c, const Index3& step) {
      if (!has_particles(c)) return;
      const Record* tile = &tiles[std::size_t{tile_nodes} * c];
      for_common_nodes(box_[c], {-step[0], -step[1], -step[2]}, [&](int tile_node, int node) { sum[node] += tile[tile_node]; });
    });
  }

  /// Copies the nodes of a block's box into a tile.
  template <class Record>
  void gather(const AlignedArray<Record>& nodes, int b, Record* tile) const {
    for_neighbours(b, [&](int c, const Index3& step) {
      const Record* block = &nodes[std::size_t{block_nodes} * c];
      for_common_nodes(box_[b], step, [&](int tile_node, int node) { tile[tile_node] = block[node]; });
    });
  }

 private:
  /// Tile nodes from low to before high; in the plane one layer.
  struct Box {
    Index3 low, high;
  };

  static Pack positions(const std::array<double, 3>& x) { return Dim == 2 ? Pack{x[0], x[1], 0., 0.} : Pack{0., x[0], x[1], x[2]}; }

  /// Two per cell along each axis; half: counts half cells. The first block along each axis stays empty.
  Particle particle(const Index3& half) const {
    Particle p{0, {}, Dim == 2 ? .25 : .125};
    int block = 0, node = 0;
    for (int d = Dim - 1; d >= 0; --d) {
      p.x[d] = side + .25 + .5 * half[d];
      const int bin = static_cast<int>(p.x[d] + bin_shift);
      block = block * along_ + bin / side, node = node * side + bin % side;
    }
    p.bin = block * block_nodes + node;
    return p;
  }

  Index3 coordinates(int b) const { return {b % along_, b / along_ % along_, b / along_ / along_}; }

  /// f(neighbour, step to it) over the blocks around b and itself, always in the same order.
  template <class F>
  void for_neighbours(int b, F f) const {
    const Index3 at = coordinates(b);
    for (int sz = Dim == 3 ? -1 : 0; sz <= (Dim == 3 ? 1 : 0); ++sz) {
      for (int sy = -1; sy <= 1; ++sy) {
        for (int sx = -1; sx <= 1; ++sx) {
          const int x = at[0] + sx, y = at[1] + sy, z = at[2] + sz;
          if (x < 0 || y < 0 || z < 0 || x >= along_ || y >= along_ || z >= along_z(along_)) continue;
          f((z * along_ + y) * along_ + x, Index3{sx, sy, sz});
        }
      }
    }
  }

  /// f(i) for all i from low to before high. The empty statement keeps compilers from calling memcpy or memset for rows of a few nodes.
  template <class F>
  static void for_row(int low, int high, F f) {
    for (int i = low; i < high; ++i) {
      f(i);
      asm volatile("");
    }
  }

  /// f(tile node, node of the block) for all nodes that a tile's box and a block at `step` from it share.
  template <class F>
  static void for_common_nodes(const Box& box, const Index3& step, F f) {
    Index3 shift{0, 0, 0}, low{0, 0, 0}, high{1, 1, 1};  // tile node = node of the block + shift
    for (int d = 0; d < Dim; ++d) {
      shift[d] = step[d] * side + offset;
      low[d] = std::max(0, box.low[d] - shift[d]), high[d] = std::min(side, box.high[d] - shift[d]);
    }
    for (int k = low[2]; k < high[2]; ++k) {
      for (int j = low[1]; j < high[1]; ++j) {
        const int first = tile_node(shift[0], j + shift[1], k + shift[2]), row = (k * side + j) * side;
        for_row(low[0], high[0], [&](int i) { f(first + i, row + i); });
      }
    }
  }

  int along_;                            ///< blocks along a side; those around the material are empty
  std::vector<std::size_t> first_pack_;  ///< of each block, and the end
  std::vector<Box> box_;                 ///< of each block: what its particles touch
};

/// In large pages where the system has them on request: with pages of 4 kB, a step in 3D takes some 5 % longer.
template <class T>
AlignedArray<T> zeros(std::size_t n) {
  AlignedArray<T> array(n);
#if defined(__linux__)
  constexpr std::size_t page = 4096;
  const std::size_t before_page = (page - reinterpret_cast<std::uintptr_t>(array.data()) % page) % page;
  if (array.bytes() > before_page) {
    madvise(reinterpret_cast<char*>(array.data()) + before_page, array.bytes() - before_page, MADV_HUGEPAGE);  // refusal does no harm
  }
#endif
  std::memset(static_cast<void*>(array.data()), 0, n * sizeof(T));
  return array;
}

}  // namespace crampon::bench
