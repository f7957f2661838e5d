#pragma once
#include "crampon/step/packs.hpp"

namespace crampon {

/// Calls the material law on batches of a few packs of one run: gradients are found while walking, the law sees a batch at once,
/// and `then(pack, stencil, targets)` follows for every pack of it with the new stress.
template <int Dim, class Shape, class Then>
void update_stress(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt, const NodalVector<Dim>* velocity, Then&& then) {
  constexpr int batch_size = Dim == 2 ? 8 : 2;
  struct Waiting {
    Stencil<Dim, Shape> stencil;
    const PairTarget* targets;
    std::uint32_t pack;
  };
  alignas(64) Pack L[batch_size * Dim * Dim];
  Waiting waiting[batch_size];
  int filled = 0;
  bool healthy = true;
  Particles<Dim>& particles = state.particles;
  const auto flush = [&](const Run& run) {
    const std::size_t first = waiting[0].pack;
    const StressBatch<Dim> batch{filled,
                                 dt,
                                 L,
                                 &particles.stress[first * stress_size<Dim>],
                                 particles.history.data() + first * particles.history_size,
                                 particles.history_size};
    if (!model.materials[run.material].law->update(model.stress_state, batch)) healthy = false;
    for (int e = 0; e < filled; ++e) then(waiting[e].pack, waiting[e].stencil, waiting[e].targets);
    filled = 0;
  };
  const auto place = [&]() -> Stencil<Dim, Shape>& { return waiting[filled].stencil; };
  for_packs<Dim, Shape>(state, model, b, place,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
                          gradient<Dim, Shape>(stencil, targets, velocity, L + filled * Dim * Dim);
                          waiting[filled].targets = targets;
                          waiting[filled].pack = pack;
                          if (++filled == batch_size || pack + 1 == run.end_pack) flush(run);  // the next run has another law
                        });
  if (!healthy) state.scratch[b].health.inverted = true;
}

}  // namespace crampon
