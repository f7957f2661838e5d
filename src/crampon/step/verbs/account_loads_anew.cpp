#include "crampon/step/verbs.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/tile_loads.hpp"

namespace crampon {

template <int Dim, class Shape>
void account_loads_anew(StepWork<Dim>& work, std::size_t b) {
  const double dt = work.now.dt;
  if (!bears_loads(work.scratch[b])) return;
  const NodalVector<Dim>* velocity = gathered<Dim, Shape, &Nodes<Dim>::velocity>(work, b);
  double power = 0;
  for_touched<Dim, Shape>(work, b, [&](std::size_t i) {
    for (int k = 0; k < Dim; ++k) power += 0.5 * work.scratch[b].loads[i][k] * velocity[i][k];
  });
  work.scratch[b].ledger.load_work += power * dt;
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void account_loads_anew<DIM, SHAPE>(StepWork<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
