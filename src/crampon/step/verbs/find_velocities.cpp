#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void find_velocities(StepWork<Dim>& work, std::size_t b) {
  const std::size_t first = work.nodes.layers[b].slot(0, 0), end = work.nodes.layers[b].slot(work.nodes.layers[b].node.size(), 0);
  for (std::size_t i = first; i < end; ++i) {
    const Pack p = work.nodes.momentum[i];
    work.nodes.velocity[i] = leading<Dim>(p * splat(p[Dim] > 0 ? 1 / p[Dim] : 0.));
  }
}

template void find_velocities<2>(StepWork<2>&, std::size_t);
template void find_velocities<3>(StepWork<3>&, std::size_t);

}  // namespace crampon
