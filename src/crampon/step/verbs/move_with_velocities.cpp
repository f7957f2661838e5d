#include "crampon/step/verbs.hpp"

namespace crampon {

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

template void move_with_velocities<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void move_with_velocities<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
