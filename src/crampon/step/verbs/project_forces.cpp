#include "crampon/step/verbs.hpp"

#include "crampon/step/force_pass.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

template <int Dim, class Shape>
void project_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!work.blocks.list[b].has_particles()) return;
  NodalVector<Dim>* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.force);
  for_packs<Dim, Shape>(state, work, model, b, internal_forces<Dim, Shape>(state.particles, tiles));
  project_other_forces<Dim, Shape>(state, work, model, b, tiles);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void project_forces<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
