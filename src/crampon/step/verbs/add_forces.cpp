#include "crampon/step/verbs.hpp"

#include "crampon/step/own_nodes.hpp"

namespace crampon {

template <int Dim>
void add_forces(StepWork<Dim>& work, std::size_t b) {
  Nodes<Dim>& nodes = work.nodes;
  const NodalVector<Dim> dt = splat_as<NodalVector<Dim>>(work.now.dt);
  for_own_slots(work, b, [&](std::size_t i) { nodes.momentum[i] += as_record<Dim>(dt * nodes.force[i]); });
}

template void add_forces<2>(StepWork<2>&, std::size_t);
template void add_forces<3>(StepWork<3>&, std::size_t);

}  // namespace crampon
