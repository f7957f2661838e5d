#pragma once
/// Forces of loads on the tiles of a block, and the walk over these that their work needs.

#include "crampon/step/packs.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

/// f(tile node, layer * nodes + tile node) over all that the particles of a block touch.
template <int Dim, class Shape, class F>
[[gnu::always_inline]] inline void for_touched(const StepWork<Dim>& work, std::size_t b, F f) {
  using T = Tile<Dim, Shape>;
  const auto layers = static_cast<int>(work.nodes.layers[b].tile.size());
  for (int l = 0; l < layers; ++l) {
    const TileBox<Dim>& box = touched_box(work, b, l);
    if (box.empty()) continue;
    for (int k = Dim == 3 ? box.low[Dim - 1] : 0; k < (Dim == 3 ? box.high[Dim - 1] : 1); ++k) {
      for (int j = box.low[1]; j < box.high[1]; ++j) {
        const int row = l * T::nodes + (k * T::side + j) * T::side;
        for (int i = box.low[0]; i < box.high[0]; ++i) f(static_cast<std::size_t>(row + i));
      }
    }
  }
}

template <int Dim>
bool bears_loads(const BlockScratch<Dim>& scratch) {
  return !scratch.loaded.empty() || !scratch.faces.empty();
}

/// Forces of loads on particles and faces, for one block: kept for account_loads, and added to its tiles (N03 Eq. 28, f_ext).
template <int Dim, class Shape>
void project_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, NodalVector<Dim>* tiles);

}  // namespace crampon
