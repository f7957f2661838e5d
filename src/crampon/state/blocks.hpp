#pragma once
/// Blocks that hold particles, and their neighbours: where nodes and tiles exist (docs/theory/space.md).

#include <array>
#include <cstdint>
#include <vector>

#include "crampon/state/grid.hpp"
#include "crampon/state/particle_order.hpp"

namespace crampon {

/// Half-open box of tile nodes.
template <int Dim>
struct TileBox {
  std::array<std::int16_t, Dim> low{}, high{};
  bool empty() const {
    for (int k = 0; k < Dim; ++k) {
      if (low[k] >= high[k]) return true;
    }
    return false;
  }
  void include(const IndexVector<Dim>& node) {
    const bool was_empty = empty();
    for (int k = 0; k < Dim; ++k) {
      const auto i = static_cast<std::int16_t>(node[k]);
      low[k] = was_empty ? i : std::min(low[k], i);
      high[k] = was_empty ? static_cast<std::int16_t>(i + 1) : std::max<std::int16_t>(high[k], i + 1);
    }
  }
};

inline constexpr std::uint32_t no_block = 0xffffffffu;

template <int Dim>
struct Block {
  IndexVector<Dim> coordinates{};
  std::uint32_t first_run = 0, end_run = 0;  ///< no particles: equal
  /// Blocks around it (itself in the middle) in a fixed order, no_block where there is none.
  std::array<std::uint32_t, neighbour_count<Dim>> neighbours{};
  TileBox<Dim> touched;  ///< tile nodes that its particles reach

  bool has_particles() const { return first_run != end_run; }
  IndexVector<Dim> first_node() const {
    IndexVector<Dim> n{};
    for (int k = 0; k < Dim; ++k) n[k] = Grid<Dim>::first_node(coordinates[k]);
    return n;
  }
  /// Index in the grid of a node of the block.
  IndexVector<Dim> node(int local) const {
    IndexVector<Dim> n = unflatten<Dim>(local, block_side);
    for (int k = 0; k < Dim; ++k) n[k] += Grid<Dim>::first_node(coordinates[k]);
    return n;
  }
};

template <int Dim>
struct Blocks {
  std::vector<Block<Dim>> list;          ///< in the order of their number in the grid
  std::vector<std::uint32_t> of_number;  ///< block number in the grid -> index in list, or no_block
  std::size_t size() const { return list.size(); }
};

}  // namespace crampon
