#include "crampon/step/release_faces.hpp"

#include "crampon/step/particle_view.hpp"
#include "crampon/step/tip_frame.hpp"
#include "crampon/step/tip_room.hpp"

namespace crampon {

namespace {

/// Mean Cauchy stress of the particles of a tip's body within a cell of a place, Pa.
Tensor2 stress_about(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch, const Vec<2>& x) {
  const double h = model.grid.largest_cell();
  Tensor2 sum{};
  double weights = 0;
  for (const WatchedParticle& w : watch.particles) {
    if (state.particles.is_padding(w.slot) || !belong_together(model, w.material, tip.material)) continue;
    const Vec<2> y = (state.particles.position(w.slot) - x) * (1 / h);
    const double square = dot(y, y);
    if (square > 1) continue;
    const int l = static_cast<int>(w.slot % lanes);
    const PackView<2> view(state, model, w.material, w.slot / lanes);
    const Pack* tau = view.stress();
    const double weight = state.particles.volume(w.slot) * (1 - square) * (1 - square), to_cauchy = view.report().to_cauchy[l];
    sum[0] += Vec<2>{{tau[0][l], tau[2][l]}} * (to_cauchy * weight);
    sum[1] += Vec<2>{{tau[2][l], tau[1][l]}} * (to_cauchy * weight);
    weights += weight;
  }
  if (!(weights > 0)) return {};
  return {sum[0] * (1 / weights), sum[1] * (1 / weights)};
}

}  // namespace

void release_faces(State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch, std::size_t added, double until) {
  Crack<2>& crack = state.cracks.list[tip.crack];
  const double since = state.clock.time, thickness = model.materials[tip.material].thickness;
  const TipVertices vertices(crack, tip);
  for (std::size_t k = 0; k < added; ++k) {
    const Vec<2>&a = crack.plane[vertices[k]], &b = crack.plane[vertices[k + 1]];
    const Vec<2> way = a - b, down = Vec<2>{{way[1], -way[0]}} * vertices.sign();  // out of the upper face, as long as the segment
    const Tensor2 stress = stress_about(state, model, tip, watch, (a + b) * 0.5);
    const Vec<2> half = Vec<2>{{dot(stress[0], down), dot(stress[1], down)}} * (0.5 * thickness);
    for (const std::size_t v : {vertices[k], vertices[k + 1]})
      crack.fading.push_back({static_cast<std::uint32_t>(v), half, half, {}, since, until});
  }
  for (FadingTraction<2>& f : crack.fading)
    f.opening = crack.upper[f.vertex] - crack.lower[f.vertex];  // surface points are where their new carriers are
}

}  // namespace crampon
