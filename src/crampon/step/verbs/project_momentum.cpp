#include "crampon/step/verbs.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/moment_projection.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

template <int Dim, class Shape>
void project_momentum(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!work.blocks.list[b].has_particles()) return;
  Pack* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.momentum);
  const Particles<Dim>& particles = state.particles;
  const Pack* offsets = work.nodes.layers[b].offsets.start.data();
  MomentProjection<Dim, Shape> moments(state, work, model, b);
  for_packs<Dim, Shape>(
      state, work, model, b,
      [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run)
          __attribute__((always_inline)) {
            const Pack m_p = particles.mass_volume[2 * std::size_t{pack}];
            Pack record[lanes];
            for (int l = 0; l < lanes; ++l) record[l] = particles.momentum_record(std::size_t{pack} * lanes + l, m_p[l]);
            scatter<Dim, Shape>(stencil, targets, offsets, record, tiles);
            moments.add(pack, stencil, targets, run, m_p);
          });
  moments.finish();
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void project_momentum<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
