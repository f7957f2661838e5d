#include "crampon/step/assemble_momentum.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

template <int Dim, class Shape>
void assemble_momentum(StepWork<Dim>& work, std::size_t b) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(work, b, l, work.nodes.momentum);
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void assemble_momentum<DIM, SHAPE>(StepWork<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
