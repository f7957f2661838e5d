#include "crampon/run/initial_stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "crampon/material/initial_state.hpp"
#include "crampon/run/build_bodies.hpp"
#include "crampon/step/particle_view.hpp"

namespace crampon {

namespace {

template <int Dim>
using ChosenStress = std::array<double, chosen_stress_size<Dim>>;

template <int Dim>
class StressAtStart {
 public:
  explicit StressAtStart(const Problem& problem) {
    for (std::size_t k = 0; k < problem.method.body_force.size(); ++k) g_[k] = problem.method.body_force[k](0, {});
  }

  ChosenStress<Dim> operator()(const InitialStressInput& in, double density, const Vec<Dim>& x) const {
    ChosenStress<Dim> out{};
    if (const auto* given = std::get_if<ComponentStress>(&in)) {
      const auto value = [&](const std::optional<ValueFunction>& f) { return f ? (*f)(0, in_space(x)) : 0.; };
      if constexpr (Dim == 2) {
        out = {value(given->xx), value(given->yy), value(given->xy)};
      } else {
        out = {value(given->xx), value(given->yy), value(given->zz), value(given->xy), value(given->yz), value(given->xz)};
      }
    }
    if (const auto* rest = std::get_if<GravityStress>(&in)) {
      Vec<Dim> from_surface = x;
      for (int k = 0; k < Dim; ++k) from_surface[k] -= rest->surface[static_cast<std::size_t>(k)];
      const Vec<Dim> down = normalized(g_);
      const double vertical = -density * std::max(0., dot(g_, from_surface));
      const auto component = [&](int i, int k) {
        return vertical * ((1 - rest->lateral) * down[i] * down[k] + (i == k ? rest->lateral : 0.));
      };
      if constexpr (Dim == 2) {
        out = {component(0, 0), component(1, 1), component(0, 1)};
      } else {
        out = {component(0, 0), component(1, 1), component(2, 2), component(0, 1), component(1, 2), component(0, 2)};
      }
    }
    return out;
  }

 private:
  Vec<Dim> g_;
};

}  // namespace

template <int Dim>
void bear_initial_stress(const Problem& problem, const Model<Dim>& model, State<Dim>& state, std::vector<Diagnostic>& errors) {
  const auto bears = [&](std::size_t body) {
    return body < problem.bodies.size() && !std::holds_alternative<NoInitialStress>(problem.bodies[body].initial_stress);
  };
  const StressAtStart<Dim> stress_at_start(problem);
  Particles<Dim>& particles = state.particles;
  std::vector<bool> told(problem.bodies.size(), false);
  for (const Run& run : state.order.runs) {
    const MaterialLaw& law = *model.materials[run.material].law;
    for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
      std::array<Pack, chosen_stress_size<Dim>> cauchy;
      cauchy.fill(splat(0.));
      std::size_t bearing = problem.bodies.size();
      for (int l = 0; l < lanes; ++l) {
        const std::size_t p = k * lanes + static_cast<std::size_t>(l), body = particles.body[p];
        if (!bears(body)) continue;
        bearing = body;
        const ChosenStress<Dim> stress = stress_at_start(problem.bodies[body].initial_stress, law.density(), particles.position(p));
        for (std::size_t c = 0; c < stress.size(); ++c) cauchy[c][l] = stress[c];
      }
      if (bearing == problem.bodies.size()) continue;
      Pack* history = particles.history.data() + k * static_cast<std::size_t>(particles.history_size);
      Pack* stress = &particles.stress[k * stress_size<Dim>];
      if (find_initial_state<Dim>(law, model.stress_state, cauchy.data(), stress, history)) {
        // Forces are those of the stored stress on the volume at no stress: together those of the Cauchy stress on the volume now.
        particles.mass_volume[2 * k + 1] *= PackView<Dim>(state, model, run.material, k).report().to_cauchy;
      } else if (!told[bearing]) {
        told[bearing] = true;
        const BodyInput& body = problem.bodies[bearing];
        errors.push_back({body.at("initial_stress"),
                          fmt::format("the material \"{}\" cannot bear the initial stress of \"{}\"", body.material, body.name),
                          "the law has no elastic strain with that stress",
                          "check the unit and the sign (tension is positive), or use a stiffer material"});
      }
    }
  }
}

template void bear_initial_stress<2>(const Problem&, const Model<2>&, State<2>&, std::vector<Diagnostic>&);
template void bear_initial_stress<3>(const Problem&, const Model<3>&, State<3>&, std::vector<Diagnostic>&);

}  // namespace crampon
