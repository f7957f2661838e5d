#include "crampon/step/verbs.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

template <int Dim, class Shape>
void assemble_forces(StepWork<Dim>& work, std::size_t b) {
  Nodes<Dim>& nodes = work.nodes;
  const BlockLayers<Dim>& layers = nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(work, b, l, nodes.force);
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void assemble_forces<DIM, SHAPE>(StepWork<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
