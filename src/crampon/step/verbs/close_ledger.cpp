#include "crampon/step/verbs.hpp"

#include <algorithm>

namespace crampon {

template <int Dim>
void close_ledger(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  state.ledger.reactions.assign(model.conditions.size(), {});
  const double in_interfaces = state.ledger.energy.interfaces;
  state.ledger.energy.interfaces = 0;
  state.ledger.rigid_reactions.assign(model.rigid_bodies.size(), {});
  std::int64_t unsolved = 0, crowded = 0;
  for (auto& scratch : work.scratch) {
    BlockLedger<Dim>& ledger = scratch.ledger;
    state.ledger.energy.load_work += ledger.load_work;
    state.ledger.energy.body_work += ledger.body_work;
    state.ledger.energy.boundary_work += ledger.boundary_work;
    state.ledger.energy.damping += ledger.damping;
    state.ledger.energy.transfer_loss += ledger.transfer_loss;
    state.ledger.energy.contact_loss += ledger.contact_loss;
    state.ledger.energy.friction_loss += ledger.friction_loss;
    state.ledger.energy.interfaces += ledger.interface_energy;
    for (const auto& r : ledger.reactions) state.ledger.reactions[r.condition] += r.force;
    for (const auto& r : ledger.rigid) {
      state.ledger.rigid_reactions[r.body].force += r.on_material.force;
      state.ledger.rigid_reactions[r.body].torque += r.on_material.torque;
    }
    unsolved += ledger.unsolved_nodes;
    crowded += ledger.crowded_nodes;
    if (scratch.health.left_margin) state.order.must_reorder = true;
    ledger.clear();
  }
  state.ledger.energy.contact_loss -= state.ledger.energy.interfaces - in_interfaces;  // taken from the particles, but not lost
  state.ledger.most_unsolved_nodes = std::max(state.ledger.most_unsolved_nodes, unsolved);
  state.ledger.most_crowded_nodes = std::max(state.ledger.most_crowded_nodes, crowded);
}

template void close_ledger<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void close_ledger<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
