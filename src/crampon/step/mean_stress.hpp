#pragma once
/// Cauchy stress of particles in the plane, and means of it about tips of cracks.

#include <optional>

#include "crampon/crack/tip_domain.hpp"
#include "crampon/step/particle_view.hpp"
#include "crampon/step/tip_room.hpp"
#include "crampon/step/tip_watch.hpp"

namespace crampon {

/// Of a particle of a pack, Pa. to_cauchy: of the pack's report.
inline Tensor2 cauchy_stress(const PackView<2>& pack, const Pack& to_cauchy, std::size_t lane) {
  const Pack* tau = pack.stress();
  const int l = static_cast<int>(lane);
  return {Vec<2>{{tau[0][l], tau[2][l]}} * to_cauchy[l], Vec<2>{{tau[2][l], tau[1][l]}} * to_cauchy[l]};
}
/// Of the particle in a slot, Pa.
inline Tensor2 cauchy_stress(const State<2>& state, const Model<2>& model, std::uint32_t material, std::size_t slot) {
  const PackView<2> pack(state, model, material, slot / lanes);
  return cauchy_stress(pack, pack.report().to_cauchy, slot % lanes);
}

/// Mean over the particles about a tip that belong to its body, Pa, by volume times weigh(slot); those with a weight of 0 do not count. None where none counts.
template <class Weigh>
std::optional<Tensor2> mean_stress(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch, Weigh weigh) {
  Tensor2 sum{};
  double weights = 0;
  for (const WatchedParticle& w : watch.particles) {
    if (state.particles.is_padding(w.slot) || !belong_together(model, w.material, tip.material)) continue;
    const double weight = state.particles.volume(w.slot) * weigh(w.slot);
    if (weight == 0) continue;
    const Tensor2 stress = cauchy_stress(state, model, w.material, w.slot);
    for (std::size_t i = 0; i < 2; ++i) sum[i] += stress[i] * weight;
    weights += weight;
  }
  if (!(weights > 0)) return std::nullopt;
  return Tensor2{sum[0] * (1 / weights), sum[1] * (1 / weights)};
}

}  // namespace crampon
