#pragma once
#include "crampon/step/packs.hpp"

namespace crampon {

/// Velocity gradients of a pack are taken where particles are at the start of the step. What carries them from there to where they move
/// (USL, MUSL) has the deformation I + L dt, what brought them there (USF) the inverse of I - L dt, and of the two halves of USAVG one ends and
/// the other begins there. Laws of large deformation apply I + L dt + (L dt)^2/2, right for L in the middle of the path: L - ahead L^2, with
/// half the step as `ahead`, negative for USF.
template <int Dim>
void take_to_middle(Pack* L, double ahead) {
  Pack square[Dim * Dim];
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) {
      Pack sum = L[i * Dim] * L[j];
      for (int k = 1; k < Dim; ++k) sum = fused(L[i * Dim + k], L[k * Dim + j], sum);
      square[i * Dim + j] = sum;
    }
  }
  for (int c = 0; c < Dim * Dim; ++c) L[c] = fused(splat(-ahead), square[c], L[c]);
}

/// By which the middle of the path is ahead of where gradients are taken, s. Nothing where positions do not lead (N03 Eq. 30).
template <int Dim>
double way_to_middle(const Model<Dim>& model, double dt) {
  if (model.positions != PositionUpdate::strain || model.stress_update == StressUpdate::usavg) return 0;
  return model.stress_update == StressUpdate::usf ? -0.5 * dt : 0.5 * dt;
}

/// What laws of small strain leave out of a velocity gradient: its antisymmetric part.
template <int Dim>
void add_turn(const Pack* L, double dt, Pack* turn);
template <>
inline void add_turn<2>(const Pack* L, double dt, Pack* turn) {
  turn[0] = fused(splat(0.5 * dt), L[2] - L[1], turn[0]);
}
template <>
inline void add_turn<3>(const Pack* L, double dt, Pack* turn) {
  turn[0] = fused(splat(0.5 * dt), L[7] - L[5], turn[0]);
  turn[1] = fused(splat(0.5 * dt), L[2] - L[6], turn[1]);
  turn[2] = fused(splat(0.5 * dt), L[3] - L[1], turn[2]);
}

/// Of a few packs. Not inlined: few problems need it, and all would pay for the registers.
template <int Dim>
[[gnu::noinline]] void add_turns(const Pack* L, double dt, std::uint32_t first, std::uint32_t end, Particles<Dim>& particles) {
  for (std::uint32_t k = first; k < end; ++k)
    add_turn<Dim>(L + (k - first) * Dim * Dim, dt, &particles.turn[std::size_t{k} * turn_size<Dim>]);
}

/// Calls the material law on batches of a few packs of one run: gradients are found while walking, the law sees a batch at once,
/// and `then(pack, stencil, targets, run)` follows for every pack of it with the new stress. offsets: of folded pairs, for the time of the velocities.
template <int Dim, class Shape, class Then>
void update_stress(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, double dt,
                   const NodalVector<Dim>* velocity, const std::vector<Pack>& offsets, Then&& then) {
  constexpr int batch_size = Dim == 2 ? 8 : 2;
  alignas(64) Pack L[batch_size * Dim * Dim];
  bool healthy = true;
  const double ahead = way_to_middle(model, dt);
  Particles<Dim>& particles = state.particles;
  for_batches<batch_size, Dim, Shape>(
      state, work, model, b, [&](const auto& stencils, const Run& run, std::uint32_t first, std::uint32_t end, const auto* factors) {
        for (std::uint32_t k = first; k < end; ++k) {
          gradient<Dim, Shape>(Stencil<Dim, Shape>(factors[k - first]), stencils.targets(k), offsets.data(), velocity,
                               L + (k - first) * Dim * Dim);
        }
        const MaterialLaw& law = *model.materials[run.material].law;
        if (ahead != 0 && law.follows_deformation()) {
          for (std::uint32_t k = first; k < end; ++k) take_to_middle<Dim>(L + (k - first) * Dim * Dim, ahead);
        }
        if (particles.keeps_turn && !law.follows_deformation()) add_turns(L, dt, first, end, particles);
        const StressBatch<Dim> batch{static_cast<int>(end - first),
                                     dt,
                                     L,
                                     &particles.stress[std::size_t{first} * stress_size<Dim>],
                                     particles.history.data() + std::size_t{first} * particles.history_size,
                                     particles.history_size};
        if (!law.update(model.stress_state, batch)) healthy = false;
        for (std::uint32_t k = first; k < end; ++k) then(k, Stencil<Dim, Shape>(factors[k - first]), stencils.targets(k), run);
      });
  if (!healthy) work.scratch[b].health.inverted = true;
}

}  // namespace crampon
