#include "crampon/step/release_faces.hpp"

#include <cmath>

#include "crampon/step/mean_stress.hpp"
#include "crampon/step/tip_frame.hpp"

namespace crampon {

void release_faces(State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch, std::size_t added, double until) {
  Crack<2>& crack = state.cracks.list[tip.crack];
  const double since = state.clock.time, thickness = model.materials[tip.material].thickness;
  const TipVertices vertices(crack, tip);
  for (std::size_t k = 0; k < added; ++k) {
    const Vec<2>&a = crack.plane[vertices[k]], &b = crack.plane[vertices[k + 1]];
    const Vec<2> way = a - b, down = Vec<2>{{way[1], -way[0]}} * vertices.sign();  // out of the upper face, as long as the segment
    const auto near = [&, x = (a + b) * 0.5](std::size_t slot) {                   // falls smoothly to 0 within a cell
      const Vec<2> y = (state.particles.position(slot) - x) * (1 / model.grid.largest_cell());
      const double rest = std::fmax(0, 1 - dot(y, y));
      return rest * rest;
    };
    const Tensor2 stress = mean_stress(state, model, tip, watch, near).value_or(Tensor2{});
    const Vec<2> half = Vec<2>{{dot(stress[0], down), dot(stress[1], down)}} * (0.5 * thickness);
    for (const std::size_t v : {vertices[k], vertices[k + 1]})
      crack.fading.push_back({static_cast<std::uint32_t>(v), half, half, {}, since, until});
  }
  for (FadingTraction<2>& f : crack.fading)
    f.opening = crack.upper[f.vertex] - crack.lower[f.vertex];  // surface points are where their new carriers are
}

}  // namespace crampon
