#pragma once
#include "crampon/step/packs.hpp"

namespace crampon {

/// Calls the material law on batches of a few packs of one run: gradients are found while walking, the law sees a batch at once,
/// and `then(pack, stencil, targets)` follows for every pack of it with the new stress. offsets: of folded pairs, for the time of the velocities.
template <int Dim, class Shape, class Then>
void update_stress(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt, const NodalVector<Dim>* velocity,
                   const std::vector<Pack>& offsets, Then&& then) {
  constexpr int batch_size = Dim == 2 ? 8 : 2;
  alignas(64) Pack L[batch_size * Dim * Dim];
  bool healthy = true;
  Particles<Dim>& particles = state.particles;
  for_batches<batch_size, Dim, Shape>(
      state, model, b, [&](const auto& stencils, const Run& run, std::uint32_t first, std::uint32_t end, const auto* factors) {
        for (std::uint32_t k = first; k < end; ++k) {
          gradient<Dim, Shape>(Stencil<Dim, Shape>(factors[k - first]), stencils.targets(k), offsets.data(), velocity,
                               L + (k - first) * Dim * Dim);
        }
        const StressBatch<Dim> batch{static_cast<int>(end - first),
                                     dt,
                                     L,
                                     &particles.stress[std::size_t{first} * stress_size<Dim>],
                                     particles.history.data() + std::size_t{first} * particles.history_size,
                                     particles.history_size};
        if (!model.materials[run.material].law->update(model.stress_state, batch)) healthy = false;
        for (std::uint32_t k = first; k < end; ++k) then(k, Stencil<Dim, Shape>(factors[k - first]), stencils.targets(k));
      });
  if (!healthy) state.scratch[b].health.inverted = true;
}

}  // namespace crampon
