#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/core/parallel.hpp"
#include "crampon/crack/stress_intensity.hpp"
#include "crampon/step/tip_room.hpp"
#include "crampon/step/tip_samples.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

namespace {

/// Parameters of a tip after a step of dt, s; 0: as if all were at rest.
void find_parameters(const State<2>& state, const StepWork<2>& work, const Model<2>& model, const TipWatch& watch, double dt,
                     CrackTip& tip) {
  const Crack<2>& crack = state.cracks.list[tip.crack];
  TipParameters now;
  if (tip.status == TipStatus::unborn) return;
  if (tip.status == TipStatus::joined || tip.status == TipStatus::left) {  // a tip no more
    now.no_J = now.no_K = NoParameter::outside;
    tip.now = now;
    return;
  }
  const TipRoom room = find_room(state, model, tip, watch);
  now.radius = room.radius;
  const double h = model.grid.largest_cell();
  if (room.radius < std::fmin(FractureModel::least_outer, model.fracture.outer) * h * (1 - 1e-9)) {
    now.no_J = now.no_K = room.bound;
    tip.now = now;
    ++tip.missed;
    return;
  }
  ++tip.found;
  const TipFrame frame = original_frame(model, crack, tip);
  const std::uint32_t material = *material_at_tip(state, model, frame.tip, watch);
  tip.material = material;
  const TipWeight weight(room.radius * model.fracture.inner / model.fracture.outer, room.radius);
  const std::vector<TipSample> samples = take_samples(state, work, model, frame, watch, material, room.radius, dt);
  const std::vector<FaceTraction> tractions = take_tractions(state, model, tip, room.radius, &weight);
  const std::vector<Vec<2>> path = path_behind(crack, tip, frame);
  const std::vector<CrackSideSample> sides = take_sides(path, samples, room.radius, h);
  const Vec<2> J = j_integral(samples, weight, tractions, sides);
  now.J = J[0], now.J_across = J[1];
  now.J_far = J[0];
  for (const FaceTraction& f : take_tractions(state, model, tip, std::numeric_limits<double>::infinity(), nullptr))
    now.J_far -= dot(f.traction, f.opening_step);
  const Vec<2> opening = opening_behind(model, crack, tip);
  now.phase = std::atan2(opening[0], opening[1]);

  const auto elastic = model.materials[material].law->elasticity();
  const bool one_material = std::all_of(watch.particles.begin(), watch.particles.end(), [&](const WatchedParticle& w) {
    return w.material == material || !belong_together(model, w.material, material) ||
           norm(state.particles.original[w.slot] - frame.tip) >= room.radius || model.materials[w.material].law->elasticity() == elastic;
  });
  if (!one_material) {
    now.no_K = NoParameter::materials;
  } else if (!elastic) {
    now.no_K = NoParameter::anisotropic;
  } else {
    const PlaneElasticity plane(elastic->plane_lambda(model.stress_state), elastic->mu);
    StressIntensity K;
    if (model.fracture.mixity == FractureModel::Mixity::interaction) {
      K = share(now.J, interaction_integral(samples, weight, TipPath(path), plane, tractions, sides), plane);
    } else {
      K = partition_by_opening(now.J, opening, plane);
    }
    now.K_I = K.I, now.K_II = K.II;
  }
  tip.now = now;
}

}  // namespace

template <int Dim>
void find_fracture_parameters(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  if constexpr (Dim == 2) {
    std::vector<CrackTip>& tips = state.fracture.tips;
    std::vector<CrackTip> found = tips;  // each sees where the others are
    parallel_for(tips.size(), model.threads,
                 [&](std::size_t t) { find_parameters(state, work, model, work.tips[t], work.now.dt, found[t]); });
    tips = std::move(found);
    while (state.fracture.next <= state.clock.time * (1 + 1e-12)) state.fracture.next += model.fracture.interval;
  }
}

template void find_fracture_parameters<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void find_fracture_parameters<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
