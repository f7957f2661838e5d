#include "crampon/step/verbs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "crampon/core/error.hpp"

namespace crampon {

template <int Dim>
void check_prescribed(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model) {
  const std::vector<Vec<Dim>>& load_values = work.prescribed.loads;
  const Vec<Dim>& body_force = work.prescribed.body_force;
  const double damping = work.prescribed.damping;
  const auto need = [&](bool is_number, const std::string& what, const std::string& name) {
    if (is_number) return;
    throw RunError(fmt::format("step {} (t = {:.6g} s): {}{} is not a number; correct the table or expression that gives it",
                               state.clock.step + 1, state.clock.time, what, name.empty() ? "" : " \"" + name + "\""));
  };
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const RigidPose<Dim>& end = state.rigid[b].end;
    need(is_finite(end.centre) && is_finite(end.velocity) && is_finite(end.spin), "the velocity or spin of", model.rigid_bodies[b].name);
  }
  for (const BlockScratch<Dim>& scratch : work.scratch) {
    for (const FixedComponent& f : scratch.fixed) {
      need(!f.active || (std::isfinite(f.v_old) && std::isfinite(f.v_new)), "the velocity of", model.conditions[f.condition].name);
    }
  }
  for (std::size_t l = 0; l < load_values.size(); ++l) need(is_finite(load_values[l]), "the value of", model.loads[l].name);
  need(is_finite(body_force), "the body force", "");
  const auto check_damping = [&](double value, const char* what) {
    need(std::isfinite(value), what, "");
    if (value >= 0) return;
    throw RunError(
        fmt::format("step {} (t = {:.6g} s): {} is {:.4g} 1/s, and below zero it drives the motion; correct the table or expression that "
                    "gives it",
                    state.clock.step + 1, state.clock.time, what, value));
  };
  check_damping(damping, "the damping");
  check_damping(work.prescribed.particle_damping, "the damping of particles");
}

template void check_prescribed<2>(const State<2>&, const StepWork<2>&, const Model<2>&);
template void check_prescribed<3>(const State<3>&, const StepWork<3>&, const Model<3>&);

}  // namespace crampon
