#include "crampon/step/verbs.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/interpolate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/rotation.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

namespace {

/// v += a dt. The position keeps its bits even where a is not a number, because stencils that are still to come in this step are found from
/// it.
template <int Dim>
void accelerate(Particles<Dim>& particles, std::size_t p, const MotionRecord<Dim>& m, double dt) {
  constexpr int last = motion_packs<Dim> - 1;
  Pack& q = particles.motion[p * motion_packs<Dim> + last];
  const Pack moved = fused(splat(dt), m.r[last], q);
  q = Dim == 2 ? __builtin_shufflevector(q, moved, 0, 1, 6, 7) : moved;
}

}  // namespace

template <int Dim, class Shape>
void update_velocities_and_project(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const double dt = work.now.dt;
  if (!work.blocks.list[b].has_particles()) return;
  take_up_couples(state, work, model, b, dt);
  const MotionRecord<Dim>* motion = gathered<Dim, Shape, &Nodes<Dim>::motion>(work, b);
  Pack* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.momentum);
  Particles<Dim>& particles = state.particles;
  const PairOffsets<Dim>& offsets = work.nodes.layers[b].offsets;
  for_packs<Dim, Shape>(state, work, model, b,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run&) {
                          const Pack m_p = particles.mass_volume[2 * std::size_t{pack}];
                          Pack record[lanes];
                          for (int l = 0; l < lanes; ++l) {
                            const std::size_t p = std::size_t{pack} * lanes + l;
                            accelerate(particles, p, interpolate<Dim, Shape>(stencil, targets, l, motion, offsets.motion), dt);
                            record[l] = particles.momentum_record(p, m_p[l]);
                          }
                          scatter<Dim, Shape>(stencil, targets, offsets.end.data(), record, tiles);
                        });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void update_velocities_and_project<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
