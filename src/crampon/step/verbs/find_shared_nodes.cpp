#include "crampon/step/verbs.hpp"

#include "crampon/step/assemble_momentum.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/rigid_faces.hpp"

namespace crampon {

template <int Dim, class Shape>
void find_shared_nodes(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  BlockLayers<Dim>& layers = work.nodes.layers[b];
  layers.shared.clear();
  if (layers.node.size() < 2 && !layers.near_face) return;
  assemble_momentum<Dim, Shape>(work, b);
  layers.shared.assign(block_nodes<Dim>, 0);
  for (int n = 0; n < block_nodes<Dim>; ++n) {
    int fields = 0;
    for (std::size_t l = 0; l < layers.node.size(); ++l) fields += work.nodes.momentum[layers.slot(l, n)][Dim] > 0;
    const bool at_wall = fields == 1 && layers.near_face &&
                         is_near_rigid_face(state, model, model.grid.node_position(work.blocks.list[b].node(n)), longest_reach(model));
    layers.shared[static_cast<std::size_t>(n)] = fields > 1 || at_wall;
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void find_shared_nodes<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
