#pragma once
/// Tiles to nodes and back. A node's value is the sum of the tiles that cover it, always in the same block order, so that results
/// do not depend on the number of threads (docs/theory/space.md, assembly).

#include <algorithm>
#include <type_traits>

#include "crampon/shape/stencil.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Where the own nodes of a block and the tile of its neighbour `o` overlap: rows of nodes, in local and in tile indices.
template <int Dim, class Shape>
struct Overlap {
  IndexVector<Dim> low{}, high{};  ///< local nodes of the block
  IndexVector<Dim> shift{};        ///< tile index = local index + shift
  bool empty = false;

  /// o: which neighbour of `owner` has the tile (or, seen from the tile's block, reversed); box: part of the tile.
  Overlap(const IndexVector<Dim>& step, const TileBox<Dim>& box) {
    for (int k = 0; k < Dim; ++k) {
      shift[k] = Tile<Dim, Shape>::offset - step[k] * block_side;
      low[k] = std::max(0, box.low[k] - shift[k]);
      high[k] = std::min(block_side, box.high[k] - shift[k]);
      empty = empty || low[k] >= high[k];
    }
  }
  /// f(local index, tile index, count) for every row along x. Of whole rows, which are most, the compiler knows the count.
  template <class F>
  void rows(F f) const {
    if (high[0] - low[0] == block_side) {
      for_rows(f, std::integral_constant<int, block_side>{});
    } else {
      for_rows(f, high[0] - low[0]);
    }
  }

 private:
  template <class F, class Count>
  void for_rows(F f, Count count) const {
    if constexpr (Dim == 2) {
      for (int j = low[1]; j < high[1]; ++j) {
        f(j * block_side + low[0], (j + shift[1]) * Tile<Dim, Shape>::side + low[0] + shift[0], count);
      }
    } else {
      for (int k = low[2]; k < high[2]; ++k) {
        for (int j = low[1]; j < high[1]; ++j) {
          f((k * block_side + j) * block_side + low[0],
            ((k + shift[2]) * Tile<Dim, Shape>::side + j + shift[1]) * Tile<Dim, Shape>::side + low[0] + shift[0], count);
        }
      }
    }
  }
};

/// Offset of neighbour o in blocks: -1, 0 or 1 per axis.
template <int Dim>
IndexVector<Dim> neighbour_step(int o) {
  IndexVector<Dim> s = unflatten<Dim>(o, 3);
  for (int k = 0; k < Dim; ++k) s[k] -= 1;
  return s;
}

template <int Dim, class Shape>
TileBox<Dim> whole_tile() {
  TileBox<Dim> box;
  for (int k = 0; k < Dim; ++k) box.low[k] = 0, box.high[k] = Tile<Dim, Shape>::side;
  return box;
}

template <int Dim>
int layer_of(const std::vector<Layer>& layers, const Layer& layer) {
  for (std::size_t l = 0; l < layers.size(); ++l) {
    if (layers[l] == layer) return static_cast<int>(l);
  }
  return -1;
}

/// The box of a tile layer that particles touch.
template <int Dim>
const TileBox<Dim>& touched_box(const StepWork<Dim>& work, std::size_t block, int layer) {
  const BlockLayers<Dim>& layers = work.nodes.layers[block];
  const auto l = static_cast<std::size_t>(layer);
  return layers.tile[l].cracks.empty() ? work.blocks.list[block].touched : layers.tile_box[l];
}

// Rows are a few hundred bytes: plain loops over registers, since calls of memset and memcpy, or what compilers make of them, cost more
// to begin than to do (-fno-tree-loop-distribute-patterns keeps the loops).

/// Clears the touched box of a tile.
template <int Dim, class Shape, class Record>
void clear_tile(Record* tile, const TileBox<Dim>& box) {
  if (box.empty()) return;
  constexpr int side = Tile<Dim, Shape>::side;
  for (int k = Dim == 3 ? box.low[Dim - 1] : 0; k < (Dim == 3 ? box.high[Dim - 1] : 1); ++k) {
    for (int j = box.low[1]; j < box.high[1]; ++j) {
      Record* row = tile + (k * side + j) * side;
      for (int i = box.low[0]; i < box.high[0]; ++i) row[i] = Record{};
    }
  }
}

template <class Record>
inline void add_record(Record& a, const Record& b) {
  if constexpr (requires { a.r[0]; }) {
    for (std::size_t i = 0; i < std::size(a.r); ++i) a.r[i] += b.r[i];
  } else {
    a += b;
  }
}

/// Sum of all tiles over the own nodes of a block, for one of its layers.
template <int Dim, class Shape, class Record>
void assemble_layer(const StepWork<Dim>& work, std::size_t block, std::size_t own_layer, NodalRecords<Record>& records,
                    bool contact_only = false) {
  const Layer& wanted = work.nodes.layers[block].node[own_layer];
  Record* out = &records[work.nodes.layers[block].slot(own_layer, 0)];
  std::fill_n(out, block_nodes<Dim>, Record{});
  const Block<Dim>& own = work.blocks.list[block];
  for (int o = 0; o < neighbour_count<Dim>; ++o) {
    const std::uint32_t c = own.neighbours[o];
    if (c == no_block || !work.blocks.list[c].has_particles()) continue;
    const BlockLayers<Dim>& layers = work.nodes.layers[c];
    if (contact_only && !layers.sums_contact) continue;
    const int layer = layer_of<Dim>(layers.tile, wanted);
    if (layer < 0) continue;
    const Overlap<Dim, Shape> overlap(neighbour_step<Dim>(o), touched_box(work, c, layer));
    if (overlap.empty) continue;
    const Record* tile = &records.tiles[(std::size_t{layers.tile_begin} + layer) * Tile<Dim, Shape>::nodes];
    overlap.rows([&](int local, int t, auto count) {
      for (int i = 0; i < count; ++i) add_record(out[local + i], tile[t + i]);
    });
  }
}

/// Asks for the nodal records of a layer ahead of time: a hint, which past the end does nothing.
template <int Dim, class Record>
void prefetch_layer(const AlignedArray<Record>& nodes, std::size_t first) {
  if (first >= nodes.size()) return;
  const char* bytes = reinterpret_cast<const char*>(&nodes[first]);
  for (std::size_t k = 0; k < block_nodes<Dim> * sizeof(Record); k += cache_line) __builtin_prefetch(bytes + k);
}

/// Copies nodal records into a tile of a block, for one of its layers, over the touched box.
template <int Dim, class Shape, class Record>
void gather_layer(const StepWork<Dim>& work, std::size_t block, int layer, const AlignedArray<Record>& nodes, Record* tile) {
  const Block<Dim>& own = work.blocks.list[block];
  const BlockLayers<Dim>& layers = work.nodes.layers[block];
  const TileBox<Dim>& box = touched_box(work, block, layer);
  for (int o = 0; o < neighbour_count<Dim>; ++o) {
    const std::uint32_t c = own.neighbours[o];
    if (c == no_block) continue;
    IndexVector<Dim> step = neighbour_step<Dim>(o);
    for (int k = 0; k < Dim; ++k) step[k] = -step[k];  // seen from the node's block, the tile is its neighbour on the other side
    const Overlap<Dim, Shape> overlap(step, box);
    if (overlap.empty) continue;
    const int there = layer_of<Dim>(work.nodes.layers[c].node, layers.tile[static_cast<std::size_t>(layer)]);
    const Record* source = &nodes[work.nodes.layers[c].slot(there, 0)];
    if (c == block) prefetch_layer<Dim>(nodes, work.nodes.layers[c].slot(there, 0) + 2 * block_nodes<Dim>);  // the block after next
    overlap.rows([&](int local, int t, auto count) {
      for (int i = 0; i < count; ++i) tile[t + i] = source[local + i];
    });
  }
}

}  // namespace crampon
