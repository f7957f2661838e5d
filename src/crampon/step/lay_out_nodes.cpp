#include "crampon/step/lay_out_nodes.hpp"

#include <algorithm>

#include "crampon/core/parallel.hpp"
#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/rigid_faces.hpp"

namespace crampon {

namespace {

/// Layers at the own nodes of a block: all that reach it from tiles around. A block that none reaches has no nodes in this step.
template <int Dim, class Shape>
void find_node_layers(StepWork<Dim>& work, std::size_t b) {
  BlockLayers<Dim>& own = work.nodes.layers[b];
  own.node.clear();
  own.node_cracks.clear();
  for (int o = 0; o < neighbour_count<Dim>; ++o) {
    const std::uint32_t c = work.blocks.list[b].neighbours[o];
    if (c == no_block) continue;
    const BlockLayers<Dim>& there = work.nodes.layers[c];
    if (!work.blocks.list[c].has_particles()) continue;
    for (std::size_t l = 0; l < there.tile.size(); ++l) {
      if (Overlap<Dim, Shape>(neighbour_step<Dim>(o), touched_box(work, c, static_cast<int>(l))).empty) continue;
      if (layer_of<Dim>(own.node, there.tile[l]) < 0) own.node.push_back(there.tile[l]);
    }
    own.node_cracks.insert(own.node_cracks.end(), there.tile_cracks.begin(), there.tile_cracks.end());
  }
  std::sort(own.node.begin(), own.node.end());
  std::sort(own.node_cracks.begin(), own.node_cracks.end());
  own.node_cracks.erase(std::unique(own.node_cracks.begin(), own.node_cracks.end()), own.node_cracks.end());
}

/// Are own nodes of a block within reach of a rigid face?
template <int Dim>
bool block_is_near_face(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  Vec<Dim> centre, half;
  const auto first = work.blocks.list[b].first_node();
  for (int k = 0; k < Dim; ++k) {
    half[k] = 0.5 * (block_side - 1) * model.grid.cell[k];
    centre[k] = model.grid.node_coordinate(k, first[k]) + half[k];
  }
  return is_near_rigid_face(state, model, centre, norm(half) + longest_reach(model));
}

/// Does a tile reach own nodes, of some block around it, that hold several layers or are near a rigid face?
template <int Dim, class Shape>
bool reaches_shared_nodes(const StepWork<Dim>& work, std::size_t b) {
  const Block<Dim>& block = work.blocks.list[b];
  if (!block.has_particles()) return false;
  for (int o = 0; o < neighbour_count<Dim>; ++o) {
    const std::uint32_t c = block.neighbours[o];
    if (c == no_block || (work.nodes.layers[c].node.size() < 2 && !work.nodes.layers[c].near_face)) continue;
    IndexVector<Dim> step = neighbour_step<Dim>(o);
    for (int k = 0; k < Dim; ++k) step[k] = -step[k];
    if (!Overlap<Dim, Shape>(step, block.touched).empty) return true;
  }
  return false;
}

}  // namespace

template <int Dim, class Shape>
void lay_out_nodes(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model,
                   const std::vector<std::vector<CrossingSums>>& crossing) {
  Nodes<Dim>& nodes = work.nodes;
  const std::size_t blocks = work.blocks.size();
  const bool cracked = !state.cracks.empty();
  const bool several = cracked || model.contact.several_fields();
  parallel_for(blocks, model.threads, [&](std::size_t b) {
    find_node_layers<Dim, Shape>(work, b);
    if (several) nodes.layers[b].near_face = block_is_near_face(state, work, model, b);
  });
  if (several) {
    parallel_for(blocks, model.threads, [&](std::size_t b) { nodes.layers[b].sums_contact = reaches_shared_nodes<Dim, Shape>(work, b); });
  }
  nodes.tile_slots = nodes.node_slots = nodes.crossing_tile_slots = nodes.crossing_node_slots = 0;
  for (BlockLayers<Dim>& l : nodes.layers) {
    l.tile_begin = static_cast<std::uint32_t>(nodes.tile_slots);
    l.node_begin = static_cast<std::uint32_t>(nodes.node_slots);
    l.crossing_tile_begin = static_cast<std::uint32_t>(nodes.crossing_tile_slots);
    l.crossing_node_begin = static_cast<std::uint32_t>(nodes.crossing_node_slots);
    nodes.tile_slots += l.tile.size();
    nodes.node_slots += l.node.size();
    nodes.crossing_tile_slots += l.tile_cracks.size();
    nodes.crossing_node_slots += l.node_cracks.size();
  }
  using T = Tile<Dim, Shape>;
  const auto on_tiles = [&](auto& records) { records.tiles.resize_discarding(nodes.tile_slots * T::nodes); };
  const auto on_nodes = [&](auto& records) { records.nodes.resize_discarding(nodes.node_slots * block_nodes<Dim>); };
  const auto on_both = [&](auto& records) { on_tiles(records), on_nodes(records); };
  on_both(nodes.momentum);
  on_both(nodes.force);
  on_nodes(nodes.velocity);
  on_nodes(nodes.motion);
  if (state.pieces.any()) on_both(nodes.arm);
  if (state.pieces.several()) on_both(nodes.piece);
  if (!several) return;
  on_both(nodes.contact);
  if (state.particles.contact.size() > 0) on_nodes(nodes.contact_gain);
  nodes.crossing.tiles.resize_discarding(nodes.crossing_tile_slots * T::nodes);
  nodes.crossing.nodes.resize_discarding(nodes.crossing_node_slots * block_nodes<Dim>);
  for (std::size_t b = 0; b < blocks; ++b) {
    std::copy(crossing[b].begin(), crossing[b].end(), nodes.crossing.tiles.begin() + nodes.layers[b].crossing_tile_begin * T::nodes);
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void lay_out_nodes<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, const std::vector<std::vector<CrossingSums>>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
