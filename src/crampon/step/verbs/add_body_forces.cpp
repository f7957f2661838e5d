#include "crampon/step/verbs.hpp"

#include "crampon/step/body_work.hpp"
#include "crampon/step/own_nodes.hpp"

namespace crampon {

template <int Dim>
void add_body_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!acts_on_bodies(work, model)) return;
  Nodes<Dim>& nodes = work.nodes;
  NodalVector<Dim> gravity = splat_as<NodalVector<Dim>>(0.);
  for (int k = 0; k < Dim; ++k) gravity[k] = work.prescribed.body_force[k];
  const NodalVector<Dim> damping = splat_as<NodalVector<Dim>>(work.prescribed.damping);
  for_deformable(work, model, b, [&](std::size_t i) {
    const Pack p = nodes.momentum[i];
    nodes.force[i] += splat_as<NodalVector<Dim>>(p[Dim]) * gravity - damping * leading<Dim>(p);
  });
}

template void add_body_forces<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void add_body_forces<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
