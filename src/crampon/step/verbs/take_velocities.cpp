#include "crampon/step/verbs.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/take_pass.hpp"

namespace crampon {

template <int Dim, class Shape>
void take_velocities(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const VelocityRule& rule = work.now.rule;
  if (!work.blocks.list[b].has_particles()) return;
  for_taken<Dim, Shape>(state, work, model, b, rule, [](std::uint32_t, const Stencil<Dim, Shape>&, const PairTarget*) {});
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void take_velocities<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
