#pragma once
#include "crampon/step/assemble.hpp"

namespace crampon {

/// A thread's own copy of nodal records over a block's tile, all layers.
template <int Dim, class Shape, class Record>
const Record* gathered(const StepWork<Dim>& work, std::size_t block, const AlignedArray<Record>& nodes) {
  static thread_local AlignedArray<Record> buffer;
  const int layers = static_cast<int>(work.nodes.layers[block].tile.size());
  buffer.resize_discarding(static_cast<std::size_t>(layers) * Tile<Dim, Shape>::nodes);
  for (int l = 0; l < layers; ++l) gather_layer<Dim, Shape>(work, block, l, nodes, buffer.data() + l * Tile<Dim, Shape>::nodes);
  return buffer.data();
}

/// A block's tiles of one quantity, cleared over what its particles touch.
template <int Dim, class Shape, class Record>
Record* cleared_tiles(const StepWork<Dim>& work, std::size_t block, AlignedArray<Record>& tiles) {
  const BlockLayers<Dim>& layers = work.nodes.layers[block];
  Record* first = &tiles[std::size_t{layers.tile_begin} * Tile<Dim, Shape>::nodes];
  for (std::size_t l = 0; l < layers.tile.size(); ++l) {
    clear_tile<Dim, Shape>(first + l * Tile<Dim, Shape>::nodes, touched_box(work, block, static_cast<int>(l)));
  }
  return first;
}

}  // namespace crampon
