#include "crampon/step/verbs.hpp"

#include "crampon/step/force_pass.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/stress_pass.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

template <int Dim, class Shape>
void update_stress_and_project_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!work.blocks.list[b].has_particles()) return;
  NodalVector<Dim>* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.force);
  update_stress<Dim, Shape>(state, work, model, b, work.now.stress_dt, gathered<Dim, Shape, &Nodes<Dim>::velocity>(work, b),
                            work.nodes.layers[b].offsets.start, internal_forces<Dim, Shape>(state.particles, tiles));
  project_other_forces<Dim, Shape>(state, work, model, b, tiles);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void update_stress_and_project_forces<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
