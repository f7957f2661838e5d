#include "crampon/step/verbs.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/tile_loads.hpp"

namespace crampon {

template <int Dim, class Shape>
void account_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const double dt = work.now.dt;
  if (!bears_loads(work.scratch[b])) return;
  const MotionRecord<Dim>* motion = gathered<Dim, Shape, &Nodes<Dim>::motion>(work, b);
  const double share = model.transfer_in(state.clock.step).re_extrapolates ? 0.5 : 1.;  // account_loads_anew adds the other half
  double power = 0;
  for_touched<Dim, Shape>(work, b, [&](std::size_t i) {
    for (int k = 0; k < Dim; ++k) {
      const double v_end = motion[i].r[0][k], a = Dim == 2 ? motion[i].r[0][2 + k] : motion[i].r[motion_packs<Dim> - 1][k];
      power += work.scratch[b].loads[i][k] * (share * v_end - 0.5 * a * dt);
    }
  });
  work.scratch[b].ledger.load_work += power * dt;
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void account_loads<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
