#pragma once
#include <type_traits>

#include "crampon/step/assemble.hpp"

namespace crampon {

/// A thread's own copy of nodal records (a member of Nodes) over a block's tile, all layers. It holds until the thread gathers the same member of
/// another block.
template <int Dim, class Shape, auto records>
const auto* gathered(const StepWork<Dim>& work, std::size_t block) {
  const auto& nodes = (work.nodes.*records).nodes;
  static thread_local std::remove_cvref_t<decltype(nodes)> buffer;
  const int layers = static_cast<int>(work.nodes.layers[block].tile.size());
  buffer.resize_discarding(static_cast<std::size_t>(layers) * Tile<Dim, Shape>::nodes);
  for (int l = 0; l < layers; ++l) gather_layer<Dim, Shape>(work, block, l, nodes, buffer.data() + l * Tile<Dim, Shape>::nodes);
  return buffer.data();
}

/// A block's tiles of one kind of records, cleared over what its particles touch.
template <int Dim, class Shape, class Record>
Record* cleared_tiles(const StepWork<Dim>& work, std::size_t block, NodalRecords<Record>& records) {
  const BlockLayers<Dim>& layers = work.nodes.layers[block];
  Record* first = &records.tiles[std::size_t{layers.tile_begin} * Tile<Dim, Shape>::nodes];
  for (std::size_t l = 0; l < layers.tile.size(); ++l) {
    clear_tile<Dim, Shape>(first + l * Tile<Dim, Shape>::nodes, touched_box(work, block, static_cast<int>(l)));
  }
  return first;
}

}  // namespace crampon
