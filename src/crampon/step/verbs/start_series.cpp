#include "crampon/step/verbs.hpp"

#include "crampon/step/velocity_series.hpp"

namespace crampon {

template <int Dim>
void start_series(StepWork<Dim>& work, std::size_t b) {
  const double dt = work.now.dt;
  const StepTransfer& transfer = work.now.transfer;
  Nodes<Dim>& nodes = work.nodes;
  const std::size_t first = nodes.layers[b].slot(0, 0), end = nodes.layers[b].slot(nodes.layers[b].node.size(), 0);
  const NodalVector<Dim> back = splat_as<NodalVector<Dim>>(transfer.of_start ? dt : 0.);
  for (std::size_t i = first; i < end; ++i) nodes.velocity[i] = moving(nodes.motion[i]) - back * acceleration(nodes.motion[i]);
}

template void start_series<2>(StepWork<2>&, std::size_t);
template void start_series<3>(StepWork<3>&, std::size_t);

}  // namespace crampon
