#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/core/parallel.hpp"
#include "crampon/crack/contour_integral.hpp"
#include "crampon/crack/stress_intensity.hpp"
#include "crampon/step/tip_room.hpp"
#include "crampon/step/tip_samples.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

namespace {

/// The most that the tractions behind a tip have dissipated on the stretch where they act, up to where they have failed first, J/m2.
double dissipated_behind(const Crack<2>& crack, const CrackTip& tip) {
  const TipVertices vertices(crack, tip);
  const CrackTractionState<2>& traction = crack.traction;
  double most = 0;
  bool on_stretch = false;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const std::size_t v = vertices[k];
    if (!(traction.area[v] > 0)) {
      if (on_stretch) break;
      continue;
    }
    on_stretch = true;
    const TractionHistory& history = traction.history[v];
    most = std::fmax(most, history.dissipated_normal + history.dissipated_shear);
    if (history.failed != 0) break;
  }
  return most;
}

/// Mean speed of a tip over about the last two cells that it has grown, m/s: it grows in leaps, and rests between them when its criterion asks for it. What it
/// has travelled of the last leap follows from the speed of the leap. 0 for a tip that does not grow, or grows no more.
double speed_of(const State<2>& state, const Model<2>& model, const CrackTip& tip) {
  if (tip.status != TipStatus::grows) return 0;
  const double leap = model.growth[tip.crack].increment, now = state.clock.time;
  double way = 0, since = now;
  for (auto e = state.ledger.events.rbegin(); e != state.ledger.events.rend() && way < 2 * model.grid.largest_cell() * (1 - 1e-9); ++e) {
    if (e->kind != CrackEvent<2>::Kind::grew || e->crack != tip.crack || e->end != tip.end) continue;
    way += since == now ? std::fmin(leap, e->speed * (now - e->time)) : leap;
    since = e->time;
  }
  return now > since ? std::fmin(way / (now - since), tip.speed) : tip.speed;
}

/// Has the material about a tip one isotropic elasticity? What stands in the way of K, if not.
NoParameter bar_to_intensities(const State<2>& state, const Model<2>& model, const TipWatch& watch, const CrackTip& tip,
                               const Vec<2>& place, double radius) {
  const auto elastic = model.materials[tip.material].law->elasticity();
  const bool one_material = std::all_of(watch.particles.begin(), watch.particles.end(), [&](const WatchedParticle& w) {
    return w.material == tip.material || !belong_together(model, w.material, tip.material) ||
           norm(state.particles.original[w.slot] - place) >= radius || model.materials[w.material].law->elasticity() == elastic;
  });
  if (!one_material) return NoParameter::materials;
  return elastic ? NoParameter::none : NoParameter::anisotropic;
}

/// Parameters of a tip after a step of dt, s; 0: as if all were at rest.
void find_parameters(const State<2>& state, const StepWork<2>& work, const Model<2>& model, const TipWatch& watch, double dt,
                     CrackTip& tip) {
  if (tip.status == TipStatus::unborn) return;
  const Crack<2>& crack = state.cracks.list[tip.crack];
  tip.now = {};
  TipParameters& now = tip.now;
  now.speed = speed_of(state, model, tip);
  if (tip.status == TipStatus::joined || tip.status == TipStatus::left) {  // a tip no more
    now.no_J = now.no_K = NoParameter::outside;
    return;
  }
  const auto give_up = [&](NoParameter why) {
    now.no_J = now.no_K = why;
    ++tip.missed;
  };
  const TipRoom room = find_room(state, model, tip, watch);
  now.radius = room.radius;
  const double h = model.grid.largest_cell();
  if (room.radius < std::fmin(FractureModel::least_outer, model.fracture.outer) * h * (1 - 1e-9)) return give_up(room.bound);
  const TipFrame frame = original_frame(model, crack, tip);
  tip.material = *material_at_tip(state, model, frame.tip, watch);
  const TipWeight weight(room.radius * model.fracture.inner / model.fracture.outer, room.radius);
  const std::vector<Vec<2>> path = path_behind(crack, tip, frame);
  const TipPath as_seen(path);
  const VirtualExtension extension(weight, as_seen, h);
  const bool along_circle = model.fracture.form == FractureModel::Form::contour;
  if (along_circle && extension.meets_corners()) return give_up(NoParameter::corner);
  ++tip.found;

  const MaterialLaw& law = *model.materials[tip.material].law;
  const std::vector<TipSample> samples = take_samples(state, work, model, frame, watch, tip.material, room.radius, dt);
  const std::vector<CrackSideSample> sides = take_sides(path, samples, room.radius, h);
  std::vector<FaceTraction> tractions = take_tractions(state, model, tip, room.radius, &extension);
  const double wave = law.wave_speed(model.stress_state);
  for (const FaceTraction& f : take_contact_tractions(state, model, tip, extension, sides, law.density() * wave * wave))
    tractions.push_back(f);
  const double middle = 0.5 * room.radius * (1 + model.fracture.inner / model.fracture.outer);
  const Vec<2> J =
      along_circle ? contour_integral(samples, as_seen, middle, h, tractions, sides) : j_integral(samples, extension, tractions, sides);
  now.J = J[0], now.J_across = J[1];
  now.J_far = J[0];
  for (const FaceTraction& f : take_tractions(state, model, tip, std::numeric_limits<double>::infinity(), nullptr))
    now.J_far -= dot(f.traction, f.opening_step);
  if (model.tractions[tip.crack].acts()) now.R = now.J + dissipated_behind(crack, tip);
  const Vec<2> opening = opening_behind(model, crack, tip);
  now.phase = std::atan2(opening[0], opening[1]);

  now.no_K = bar_to_intensities(state, model, watch, tip, frame.tip, room.radius);
  if (now.no_K != NoParameter::none) return;
  const ElasticConstants elastic = *law.elasticity();
  const PlaneElasticity plane(elastic.plane_lambda(model.stress_state), elastic.mu);
  const auto intensities = [&](const SteadyTip& as) {
    if (model.fracture.mixity == FractureModel::Mixity::opening) return partition_by_opening(now.J, opening, as);
    return share(now.J, interaction_integral(samples, extension, as_seen, as, tractions, sides), as);
  };
  const SteadyTip running(plane, law.density(), now.speed);
  const StressIntensity rest = intensities(plane);
  now.rest_I = rest.I, now.rest_II = rest.II;
  if (!running.is_slow()) {
    now.no_K = NoParameter::fast;
    return;
  }
  const StressIntensity K = now.speed > 0 ? intensities(running) : rest;
  now.K_I = K.I, now.K_II = K.II;
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
