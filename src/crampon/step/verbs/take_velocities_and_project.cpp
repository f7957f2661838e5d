#include "crampon/step/verbs.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/take_pass.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

template <int Dim, class Shape>
void take_velocities_and_project(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const VelocityRule& rule = work.now.rule;
  if (!work.blocks.list[b].has_particles()) return;
  Pack* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.momentum);
  const Pack* offsets = work.nodes.layers[b].offsets.end.data();
  for_taken<Dim, Shape>(state, work, model, b, rule,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets) {
                          Pack record[lanes];
                          for (int l = 0; l < lanes; ++l) {
                            const std::size_t p = std::size_t{pack} * lanes + static_cast<std::size_t>(l);
                            record[l] = state.particles.momentum_record(p, state.particles.mass(p));
                          }
                          scatter<Dim, Shape>(stencil, targets, offsets, record, tiles);
                        });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void take_velocities_and_project<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
