#include "crampon/step/verbs.hpp"

#include "crampon/core/parallel.hpp"
#include "crampon/step/crack_motion.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/lay_out_blocks.hpp"
#include "crampon/step/rigid_motion.hpp"

namespace crampon {

namespace {

/// x += v further for the particles of a block.
template <int Dim, class Shape>
void lead_block(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, double further) {
  const Block<Dim>& block = work.blocks.list[b];
  if (!block.has_particles()) return;
  AlignedArray<Pack>& motion = state.particles.motion;
  const std::size_t first = std::size_t{state.order.runs[block.first_run].first_pack} * lanes,
                    end = std::size_t{state.order.runs[block.end_run - 1].end_pack} * lanes;
  for (std::size_t p = first; p < end; ++p) {
    if constexpr (Dim == 2) {
      motion[p] = fused(splat(further), Pack{motion[p][2], motion[p][3], 0., 0.}, motion[p]);
    } else {
      motion[2 * p] = fused(Pack{further, further, further, 0.}, motion[2 * p + 1], motion[2 * p]);
    }
  }
  if (!model.rigid_bodies.empty()) place_rigid_particles(state, work, model, b, &RigidMotion<Dim>::start, [](const Vec<Dim>&) {});
  Pack low = splat(1e300), high = splat(-1e300);
  for (std::size_t p = first; p < end; ++p) {
    low = lane_min(low, motion[p * motion_packs<Dim>]);
    high = lane_max(high, motion[p * motion_packs<Dim>]);
  }
  find_touched_box<Dim, Shape>(work, model, b, low, high);
}

}  // namespace

template <int Dim, class Shape>
void lead_positions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const double further = work.now.further;
  if (further == 0) return;
  parallel_for(work.blocks.size(), model.threads, [&](std::size_t b) { lead_block<Dim, Shape>(state, work, model, b, further); });
  state.particles.lead = work.now.lead;
  carry_cracks(state, work);
  for (const BlockScratch<Dim>& scratch : work.scratch) state.order.must_reorder = state.order.must_reorder || scratch.health.left_margin;
  check_health<Dim, Shape>(state, work, model);
  if (state.order.must_reorder) reorder<Dim, Shape>(state, work, model);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void lead_positions<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
