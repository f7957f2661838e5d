#include "crampon/step/lead_positions.hpp"

#include "crampon/core/parallel.hpp"
#include "crampon/step/guard.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/move_cracks.hpp"
#include "crampon/step/reorder.hpp"
#include "crampon/step/rigid_motion.hpp"

namespace crampon {

namespace {

/// x += v further for the particles of a block.
template <int Dim, class Shape>
void lead_block(State<Dim>& state, const Model<Dim>& model, std::size_t b, double further) {
  const Block<Dim>& block = state.blocks.list[b];
  if (!block.has_particles()) return;
  AlignedArray<Pack>& motion = state.particles.motion;
  const std::size_t first = std::size_t{state.blocks.runs[block.first_run].first_pack} * lanes,
                    end = std::size_t{state.blocks.runs[block.end_run - 1].end_pack} * lanes;
  for (std::size_t p = first; p < end; ++p) {
    if constexpr (Dim == 2) {
      motion[p] = fused(splat(further), Pack{motion[p][2], motion[p][3], 0., 0.}, motion[p]);
    } else {
      motion[2 * p] = fused(Pack{further, further, further, 0.}, motion[2 * p + 1], motion[2 * p]);
    }
  }
  if (!model.rigid_bodies.empty()) place_rigid_particles(state, model, b, &RigidMotion<Dim>::start, [](const Vec<Dim>&) {});
  Pack low = splat(1e300), high = splat(-1e300);
  for (std::size_t p = first; p < end; ++p) {
    low = lane_min(low, motion[p * motion_packs<Dim>]);
    high = lane_max(high, motion[p * motion_packs<Dim>]);
  }
  find_touched_box<Dim, Shape>(state, model, b, low, high);
}

}  // namespace

template <int Dim, class Shape>
void lead_positions(State<Dim>& state, const Model<Dim>& model, double dt) {
  const double lead = position_lead(model, dt), further = lead - state.particles.lead;
  if (further == 0) return;
  parallel_for(state.blocks.size(), model.threads, [&](std::size_t b) { lead_block<Dim, Shape>(state, model, b, further); });
  state.particles.lead = lead;
  carry_cracks(state);
  for (const BlockScratch<Dim>& scratch : state.scratch) state.must_reorder = state.must_reorder || scratch.health.left_margin;
  check_health<Dim, Shape>(state, model, dt);
  if (state.must_reorder) reorder<Dim, Shape>(state, model);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void lead_positions<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, double);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
