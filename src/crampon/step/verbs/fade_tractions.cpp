#include <algorithm>

#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void fade_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  if (!model.any_growth()) return;
  const double end = state.clock.time + work.now.dt;
  for (Crack<Dim>& crack : state.cracks.list) {
    for (FadingTraction<Dim>& f : crack.fading) {
      const Vec<Dim> opening = crack.upper[f.vertex] - crack.lower[f.vertex];
      state.fracture.energy -= dot(f.force, opening - f.opening);
      f.opening = opening;
      f.force = f.at_first * std::max(0., (f.until - end) / (f.until - f.since));
    }
    std::erase_if(crack.fading, [&](const FadingTraction<Dim>& f) { return end >= f.until; });
  }
}

template void fade_tractions<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void fade_tractions<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
