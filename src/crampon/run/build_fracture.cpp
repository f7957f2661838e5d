#include "crampon/run/build_fracture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "crampon/run/build_nucleation.hpp"
#include "crampon/step/tip_frame.hpp"

namespace crampon {

namespace {

/// Of the fastest material, m/s: c_s (.862 + 1.14 nu)/(1 + nu) (Viktorov, Rayleigh and Lamb Waves).
double rayleigh_speed(const Model<2>& model) {
  double fastest = 0;
  for (const Material<2>& m : model.materials) {
    const auto elastic = m.law->elasticity();
    const double nu = elastic ? elastic->lambda / (2 * (elastic->lambda + elastic->mu)) : 0.3;
    const double shear = elastic ? std::sqrt(elastic->mu / m.law->density()) : 0.5 * m.law->wave_speed(model.stress_state);
    fastest = std::fmax(fastest, shear * (0.862 + 1.14 * nu) / (1 + nu));
  }
  return fastest;
}

/// Of half a cell, s: between two looks at what may grow or start. h: cell, m; rayleigh: m/s.
double time_to_pass(double h, double rayleigh) { return 0.5 * h / rayleigh; }

/// h: cell, m; rayleigh: m/s.
GrowthModel build_growth(const GrowthInput& in, double h, double rayleigh) {
  GrowthModel out;
  out.criterion = in.criterion, out.alternate = in.alternate;
  out.end = {in.ends != GrowthInput::Ends::end, in.ends != GrowthInput::Ends::start};
  out.direction = in.direction;
  if (!in.along.empty()) out.along = {{in.along[0], in.along[1]}};
  out.increment = in.increment * h;
  out.largest_speed = in.largest_speed.value_or(rayleigh);
  out.by_rate = in.speed_by_drive;
  if (in.largest_growth) out.largest_growth = *in.largest_growth;
  out.start = in.start;
  out.interval = time_to_pass(h, rayleigh);
  out.release = in.release * h;
  out.bridged = in.bridged;
  out.resistance.grown = in.r_curve_growth, out.resistance.factor = in.r_curve_factor;
  out.resistance.speed = in.rate_speed.value_or(0), out.resistance.exponent = in.rate_exponent;
  return out;
}

/// By number of a particle: does a load act on it? Empty without loads.
std::vector<bool> loaded_particles(const Model<2>& model, std::size_t count) {
  if (model.loads.empty()) return {};
  std::vector<bool> loaded(count);
  for (const Load<2>& load : model.loads) {
    for (const std::uint32_t p : load.particles) loaded[p] = true;
  }
  for (const std::uint32_t p : model.faces.particles) loaded[p] = true;
  return loaded;
}

}  // namespace

void build_fracture(const Problem& problem, const BuiltBodies<2>& bodies, Model<2>& model, State<2>& state) {
  if (!problem.fracture) return;
  const FractureInput& in = *problem.fracture;
  FractureModel& fracture = model.fracture;
  fracture.on = true;
  fracture.inner = in.inner_radius, fracture.outer = in.outer_radius;
  fracture.mixity = in.mixity, fracture.form = in.form;
  double fastest = 0;
  for (const Material<2>& m : model.materials) fastest = std::fmax(fastest, m.law->wave_speed(model.stress_state));
  fracture.interval = in.interval.value_or(fracture.outer * model.grid.smallest_cell() / fastest);
  fracture.loaded = loaded_particles(model, bodies.particles.size());
  const double h = model.grid.largest_cell(), rayleigh = rayleigh_speed(model);
  const auto growth_of = [&](const std::optional<GrowthInput>& growth) {
    return growth ? build_growth(*growth, h, rayleigh) : GrowthModel{};
  };
  for (const CrackInput& crack : problem.cracks) model.growth.push_back(growth_of(crack.growth));
  for (const NucleationInput& nucleation : problem.nucleations) {
    const auto first = static_cast<std::uint32_t>(model.growth.size());
    model.nucleations.push_back(build_nucleation(problem, nucleation, bodies, model, time_to_pass(h, rayleigh), first));
    model.growth.insert(model.growth.end(), static_cast<std::size_t>(nucleation.most), growth_of(nucleation.growth));
    state.fracture.nucleations.emplace_back().next = nucleation.start;
  }
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    if (crack.closed) continue;
    for (const std::size_t end : {0, 1}) {
      CrackTip tip;
      tip.crack = static_cast<std::uint32_t>(c);
      tip.end = static_cast<std::uint8_t>(end);
      if (crack.plane.empty()) {
        tip.status = TipStatus::unborn;
      } else {
        const std::size_t v = end == 0 ? 0 : crack.plane.size() - 1;
        if (crack.extension[end] > 0 || crack.mirrored[end] != 0 || !state.observed.cracked[c][v]) continue;
        tip.initial = original_frame(model, crack, tip).ahead;
      }
      state.fracture.tips.push_back(tip);
    }
  }
}

}  // namespace crampon
