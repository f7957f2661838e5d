#include "crampon/step/verbs.hpp"

#include "crampon/step/body_work.hpp"
#include "crampon/step/own_nodes.hpp"

namespace crampon {

template <int Dim>
void account_body_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!acts_on_bodies(work, model)) return;
  const Nodes<Dim>& nodes = work.nodes;
  const double dt = work.now.dt, damping = work.prescribed.damping;
  const Vec<Dim>& body_force = work.prescribed.body_force;
  BlockLedger<Dim>& ledger = work.scratch[b].ledger;
  for_deformable(work, model, b, [&](std::size_t i) {
    const Pack p = nodes.momentum[i];
    const double m = p[Dim];
    const NodalVector<Dim> v_start = nodes.velocity[i];
    const NodalVector<Dim> v = 0.5 * (v_start + leading<Dim>(p * splat(m > 0 ? 1 / m : 0.)));
    for (int k = 0; k < Dim; ++k) {
      ledger.body_work += dt * m * body_force[k] * v[k];
      ledger.damping += dt * damping * m * v_start[k] * v[k];
    }
  });
}

template void account_body_forces<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void account_body_forces<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
