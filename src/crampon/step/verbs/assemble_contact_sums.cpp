#include "crampon/step/verbs.hpp"

#include <algorithm>

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

template <int Dim, class Shape>
void assemble_contact_sums(StepWork<Dim>& work, std::size_t b) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  if (layers.shared.empty()) return;
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(work, b, l, work.nodes.contact, true);
  }
  // Normals belong to cracks, not to layers, and are kept for the whole tile.
  for (std::size_t c = 0; c < layers.node_cracks.size(); ++c) {
    CrossingSums* out = &work.nodes.crossing[(layers.crossing_node_begin + c) * block_nodes<Dim>];
    std::fill_n(out, block_nodes<Dim>, CrossingSums{});
    for (int o = 0; o < neighbour_count<Dim>; ++o) {
      const std::uint32_t there = work.blocks.list[b].neighbours[o];
      if (there == no_block) continue;
      const BlockLayers<Dim>& tile = work.nodes.layers[there];
      const auto at = std::lower_bound(tile.tile_cracks.begin(), tile.tile_cracks.end(), layers.node_cracks[c]);
      if (at == tile.tile_cracks.end() || *at != layers.node_cracks[c]) continue;
      const CrossingSums* sums =
          &work.nodes.crossing
               .tiles[(tile.crossing_tile_begin + static_cast<std::size_t>(at - tile.tile_cracks.begin())) * Tile<Dim, Shape>::nodes];
      Overlap<Dim, Shape>(neighbour_step<Dim>(o), whole_tile<Dim, Shape>()).rows([&](int local, int t, int count) {
        for (int i = 0; i < count; ++i) add_record(out[local + i], sums[t + i]);
      });
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void assemble_contact_sums<DIM, SHAPE>(StepWork<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
