#include "crampon/step/tile_loads.hpp"

#include "crampon/step/face_loads.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

namespace {

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
          at_target<Dim, Shape>(stencil, targets, l, n, tiles, [&](NodalVector<Dim>& q, unsigned flip) {
            q = fused(splat_as<NodalVector<Dim>>(stencil.weight(n, l)), flipped(f_p, flip), q);
          });
        }
      });
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

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void project_loads<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t, NodalVector<DIM>*);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
