#include "crampon/step/project_loads.hpp"

#include "crampon/step/face_loads.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

namespace {

/// f(tile node, layer * nodes + tile node) over all that the particles of a block touch.
template <int Dim, class Shape, class F>
void for_touched(const StepWork<Dim>& work, std::size_t b, F f) {
  using T = Tile<Dim, Shape>;
  const auto layers = static_cast<int>(work.nodes.layers[b].tile.size());
  for (int l = 0; l < layers; ++l) {
    const TileBox<Dim>& box = touched_box(work, b, l);
    if (box.empty()) continue;
    for (int k = Dim == 3 ? box.low[Dim - 1] : 0; k < (Dim == 3 ? box.high[Dim - 1] : 1); ++k) {
      for (int j = box.low[1]; j < box.high[1]; ++j) {
        const int row = l * T::nodes + (k * T::side + j) * T::side;
        for (int i = box.low[0]; i < box.high[0]; ++i) f(static_cast<std::size_t>(row + i));
      }
    }
  }
}

/// f_p S_ip of forces on particles.
template <int Dim, class Shape>
void project_particle_loads(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                            NodalVector<Dim>* tiles) {
  using T = Tile<Dim, Shape>;
  for_slots<Dim, Shape>(
      state, work, model, b, work.scratch[b].loaded,
      [&](const LoadedParticle& loaded, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, const Run&) {
        NodalVector<Dim> f_p = splat_as<NodalVector<Dim>>(0.);
        for (int k = 0; k < Dim; ++k) f_p[k] = model.loads[loaded.load].share[loaded.entry] * work.prescribed.loads[loaded.load][k];
        for (int n = 0; n < T::stencil; ++n) {
          const PairTarget* pair = targets ? &targets[l * T::stencil + n] : nullptr;
          NodalVector<Dim>& q = tiles[pair ? pair->layer * T::nodes + pair->node : stencil.of.base[l] + T::steps[n]];
          q = fused(splat_as<NodalVector<Dim>>(stencil.weight(n, l)), flipped(f_p, pair ? pair->flip : 0u), q);
        }
      });
}

template <int Dim>
bool bears_loads(const BlockScratch<Dim>& scratch) {
  return !scratch.loaded.empty() || !scratch.faces.empty();
}

}  // namespace

template <int Dim, class Shape>
void project_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, NodalVector<Dim>* tiles) {
  if (!bears_loads(work.scratch[b])) return;
  AlignedArray<NodalVector<Dim>>& loads = work.scratch[b].loads;
  loads.resize_discarding(work.nodes.layers[b].tile.size() * Tile<Dim, Shape>::nodes);
  for_touched<Dim, Shape>(work, b, [&](std::size_t i) { loads[i] = splat_as<NodalVector<Dim>>(0.); });
  project_particle_loads<Dim, Shape>(state, work, model, b, loads.data());
  project_face_loads<Dim, Shape>(state, work, model, b, loads.data());
  for_touched<Dim, Shape>(work, b, [&](std::size_t i) { tiles[i] += loads[i]; });
}

template <int Dim, class Shape>
void account_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const double dt = work.now.dt;
  if (!bears_loads(work.scratch[b])) return;
  const MotionRecord<Dim>* motion = gathered<Dim, Shape>(work, b, work.nodes.motion);
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

template <int Dim, class Shape>
void account_loads_anew(StepWork<Dim>& work, std::size_t b) {
  const double dt = work.now.dt;
  if (!bears_loads(work.scratch[b])) return;
  const NodalVector<Dim>* velocity = gathered<Dim, Shape>(work, b, work.nodes.velocity);
  double power = 0;
  for_touched<Dim, Shape>(work, b, [&](std::size_t i) {
    for (int k = 0; k < Dim; ++k) power += 0.5 * work.scratch[b].loads[i][k] * velocity[i][k];
  });
  work.scratch[b].ledger.load_work += power * dt;
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                                    \
  template void project_loads<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t, NodalVector<DIM>*); \
  template void account_loads<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);                    \
  template void account_loads_anew<DIM, SHAPE>(StepWork<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
