#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void evaluate_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const double time = state.clock.time + work.now.lead;
  Prescribed<Dim>& p = work.prescribed;
  p.loads.assign(model.loads.size(), {});
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    for (int k = 0; k < Dim; ++k) p.loads[l][k] = model.loads[l].value[static_cast<std::size_t>(k)](time, {});
  }
  p.body_force = {};
  for (std::size_t k = 0; k < model.body_force.size(); ++k) p.body_force[k] = model.body_force[k](time, {});
  p.damping = model.damped ? model.damping(time, {}) : 0.;
  p.particle_damping = model.particle_damping(time, {});
  work.now.rule =
      velocity_rule(model.transfer, work.now.transfer, model.stress_update, model.positions, work.now.dt, p.damping, p.particle_damping);
}

template void evaluate_loads<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void evaluate_loads<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
