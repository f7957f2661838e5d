#pragma once
/// What contact at nodes and contact with rigid faces have in common: rules, the change of a node, and what is booked.

#include <algorithm>

#include "crampon/contact/node_solve.hpp"
#include "crampon/contact/pair_work.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

template <int Dim>
ContactRules contact_rules(const Model<Dim>& model, ContactTask task, double dt) {
  const auto& contact = model.contact;
  ContactRules rules;
  rules.task = task;
  rules.dt = dt;
  rules.literal = contact.scheme == ContactScheme::literal;
  rules.volume_for_cracks = contact.detection == ContactDetection::volume;
  rules.volume_for_materials = contact.material_detection == ContactDetection::volume;
  rules.volume_separated = contact.volume_separated;
  rules.volume_contact = contact.volume_contact;
  rules.require_approach = contact.require_approach;
  rules.sequential = contact.pairs == ContactPairs::sequential;
  rules.stays_closed_within = 0.25 * model.grid.smallest_cell();  // well above what gaps err by (docs/theory/contact.md, detection)
  return rules;
}

/// Prescribed components stay in Task 4 (N13 sec. 2.5), and in the other tasks where nothing imposes them again after contact.
template <int Dim>
bool fixes_before_contact(const Model<Dim>& model, ContactTask task) {
  return task == ContactTask::four || task == ContactTask::term || model.boundary_order == BoundaryOrder::boundary_first;
}

/// The only two ways in which contact changes a node (conventions 12): Tasks 2 and 6 change momentum alone, and Task 4 momentum and force
/// together (N13 sec. 2.5).
template <int Dim>
void change_node(Nodes<Dim>& nodes, std::size_t i, const Vec<Dim>& dp, ContactTask task, double dt) {
  for (int k = 0; k < Dim; ++k) nodes.momentum[i][k] += dp[k];
  if (task != ContactTask::four) return;
  for (int k = 0; k < Dim; ++k) nodes.force[i][k] += dp[k] / dt;
}

/// What a rigid body gives to the others in Task 4: F, N, and its moment about the body's centre.
template <int Dim>
void book_reaction(BlockLedger<Dim>& ledger, std::uint16_t body, const RigidPose<Dim>& pose, const Vec<Dim>& x, const Vec<Dim>& F) {
  if (F == Vec<Dim>{}) return;
  auto at = std::find_if(ledger.rigid.begin(), ledger.rigid.end(), [&](const auto& r) { return r.body == body; });
  if (at == ledger.rigid.end()) at = ledger.rigid.insert(ledger.rigid.end(), {body, {}});
  const Vec<Dim> r = x - pose.centre;
  at->on_material.force += F;
  at->on_material.torque[2] += r[0] * F[1] - r[1] * F[0];
  if constexpr (Dim == 3) {
    at->on_material.torque[0] += r[1] * F[2] - r[2] * F[1];
    at->on_material.torque[1] += r[2] * F[0] - r[0] * F[2];
  }
}

}  // namespace crampon
