#include "crampon/step/assemble_momenta.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/rotation.hpp"

namespace crampon {

template <int Dim, class Shape>
void assemble_momentum(StepWork<Dim>& work, std::size_t b) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(work, b, layers.node[l], work.nodes.tile_momentum, &work.nodes.momentum[layers.slot(l, 0)]);
  }
}

template <int Dim, class Shape>
void assemble_start_momenta(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (work.nodes.layers[b].shared.empty()) assemble_momentum<Dim, Shape>(work, b);  // else find_shared_nodes has
  assemble_arms<Dim, Shape>(state, work, model, b);
  carry_rotation(state, work, b, &PieceRotation<Dim>::spin, -state.particles.lead);
}

template <int Dim, class Shape>
void assemble_end_momenta(State<Dim>& state, StepWork<Dim>& work, std::size_t b) {
  assemble_momentum<Dim, Shape>(work, b);
  carry_rotation(state, work, b, &PieceRotation<Dim>::spin_end, work.now.dt - state.particles.lead);
}

template <int Dim>
void find_velocities(StepWork<Dim>& work, std::size_t b) {
  const std::size_t first = work.nodes.layers[b].slot(0, 0), end = work.nodes.layers[b].slot(work.nodes.layers[b].node.size(), 0);
  for (std::size_t i = first; i < end; ++i) {
    const Pack p = work.nodes.momentum[i];
    work.nodes.velocity[i] = leading<Dim>(p * splat(p[Dim] > 0 ? 1 / p[Dim] : 0.));
  }
}

template <int Dim>
void move_with_velocities(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (model.positions != PositionUpdate::strain) return;
  const std::size_t first = work.nodes.layers[b].slot(0, 0), end = work.nodes.layers[b].slot(work.nodes.layers[b].node.size(), 0);
  for (std::size_t i = first; i < end; ++i) {
    const NodalVector<Dim> v = work.nodes.velocity[i];
    Pack& moving = work.nodes.motion[i].r[0];
    if constexpr (Dim == 2) {
      moving = Pack{v[0], v[1], moving[2], moving[3]};
    } else {
      moving = v;
    }
  }
  for (const ContactDrift<Dim>& drift : work.scratch[b].contact.drifts) {
    for (int k = 0; k < Dim; ++k) work.nodes.motion[drift.slot].r[0][k] += drift.dv[k];
  }
}

#define CRAMPON_INSTANTIATE(DIM)                                   \
  template void find_velocities<DIM>(StepWork<DIM>&, std::size_t); \
  template void move_with_velocities<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                          \
  template void assemble_momentum<DIM, SHAPE>(StepWork<DIM>&, std::size_t);                                      \
  template void assemble_start_momenta<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t); \
  template void assemble_end_momenta<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
