#include "crampon/step/verbs.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/rotation.hpp"
#include "crampon/step/velocity_series.hpp"

namespace crampon {

template <int Dim, class Shape>
void gather_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const StepTransfer& transfer = work.now.transfer;
  const double dt = work.now.dt;
  Nodes<Dim>& nodes = work.nodes;
  const BlockLayers<Dim>& layers = nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(work, b, l, nodes.momentum);
  }
  carry_rotation(state, work, b, &PieceRotation<Dim>::spin_term, (transfer.of_start ? 0. : dt) - state.particles.lead);
  for_nodes(work, model, b, [&](std::size_t i, bool deformable) {
    Pack& p = nodes.momentum[i];
    const double mass = p[Dim];
    p = deformable ? as_record<Dim>(nodes.velocity[i]) * splat(mass) - as_record<Dim>(leading<Dim>(p)) : splat(0.);
    p[Dim] = mass;
  });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void gather_term<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
