#include "crampon/step/adjust_contact.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/contact/interface.hpp"
#include "crampon/step/boundary.hpp"

namespace crampon {

namespace {

/// The only two ways in which contact changes a node (STYLE, invariants): Tasks 2 and 6 change momentum alone ...
template <int Dim>
void add_momentum(Nodes<Dim>& nodes, std::size_t i, const Vec<Dim>& dp) {
  for (int k = 0; k < Dim; ++k) nodes.momentum[i][k] += dp[k];
}

/// ... and Task 4 momentum and force together (N13 sec. 2.5).
template <int Dim>
void add_momentum_and_force(Nodes<Dim>& nodes, std::size_t i, const Vec<Dim>& dp, double dt) {
  add_momentum(nodes, i, dp);
  for (int k = 0; k < Dim; ++k) nodes.force[i][k] += dp[k] / dt;
}

template <int Dim>
Vec<Dim> momentum_of(const Nodes<Dim>& nodes, std::size_t i) {
  Vec<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = nodes.momentum[i][k];
  return p;
}

/// Energy that contact takes from the particles in a step (docs/theory/contact.md, energy): with v- and v+ the velocities before Task 2
/// and before Task 6, and da what the forces of Task 3 add, -1/2 (J4.v- - da.J2) - 1/2 (J4.v+ - da.J6) summed over the groups; half in
/// Task 4, half in Task 6. Rigid bodies are groups like others here: what they give is work at the boundary.
template <int Dim>
double energy_taken(ContactGroup<Dim>& group, ContactTask task, const Vec<Dim>& before, bool re_extrapolates) {
  switch (task) {
    case ContactTask::two:
      group.v_start = before;
      group.v_settled = group.velocity();
      group.dp2 = group.dp;
      return 0;
    case ContactTask::four: {
      group.dp4 = group.dp;
      group.gain = before - group.v_settled;
      const double first = -0.5 * (dot(group.dp4, group.v_start) - dot(group.gain, group.dp2));
      return re_extrapolates ? first : first - 0.5 * dot(group.dp4, group.velocity());  // without Task 6 the step ends with Task 4
    }
    case ContactTask::six:
      return -0.5 * (dot(group.dp4, before) - dot(group.gain, group.dp));
    case ContactTask::term:
      return 0;
  }
  return 0;
}

template <int Dim>
Vec<Dim> relative_velocity(const ContactGroup<Dim>* groups, const ContactPair<Dim>& pair) {
  return side_of(groups, pair.b).v - side_of(groups, pair.a).v;
}

/// What Task 4 has given along the face where it slips.
template <int Dim>
Vec<Dim> rubbing(const ContactPair<Dim>& pair) {
  if (pair.state != ContactState::slip || holds_as_interface(pair)) return {};
  return pair.J - pair.n * dot(pair.J, pair.n);
}

/// Work that friction takes in a step: its impulse times the mean slip (docs/theory/contact.md, energy). The slip is that of the particles,
/// which carry the mass, in the mean about the node: w_start before and `w_end` after they have moved. Nodal velocities of Task 4 grow
/// without bound where a node holds little mass; what particles take of them does not.
template <int Dim>
double friction_work(const ContactPair<Dim>& pair, const Vec<Dim>& w_end) {
  const double share = pair.is_virtual() ? 0.5 : 1;  // there every face is met from both of its sides
  return share * std::fmax(-0.5 * dot(pair.rubbing, pair.w_start + w_end), 0.);
}

template <int Dim>
void settle_pairs(const ContactGroup<Dim>* groups, ContactPair<Dim>* pairs, int pair_count) {
  for (int q = 0; q < pair_count; ++q) pairs[q].w_settled = relative_velocity(groups, pairs[q]);
}

/// After Task 4: what particles are to remember, and what the springs of an interface hold.
template <int Dim>
void close_pair(const ContactGroup<Dim>* groups, ContactPair<Dim>& pair, double dt, BlockLedger<Dim>& ledger) {
  const PairSide<Dim> a = side_of(groups, pair.a), b = side_of(groups, pair.b);
  const Vec<Dim> w = b.v - a.v;
  if (holds_as_interface(pair)) {
    const double share = pair.is_virtual() ? 0.5 : 1;  // there every face is met from both of its sides
    ledger.interface_energy += share * interface_energy(pair, reduced_mass(a, b), w, dt);
    if (interface_load(pair, dt) >= 1) pair.history_gain = 1 - pair.history;
    pair.w_settled = w;  // positions move with it
  }
  if (std::holds_alternative<SlipWeakeningContact>(*pair.law) && pair.state == ContactState::slip) {
    const Vec<Dim> mean = (w + pair.w_settled) * 0.5;
    pair.history_gain = norm(mean - pair.n * dot(mean, pair.n)) * dt;
  }
}

/// Springs of interfaces open as Task 4 has left them: positions move with its relative velocity, which strains, of Task 6, do not see.
/// With that a spring that is held closes without a strain for each tenth that it closes.
template <int Dim>
void find_drift(ContactGroup<Dim>* groups, const ContactPair<Dim>* pairs, int pair_count) {
  for (int q = 0; q < pair_count; ++q) {
    if (!holds_as_interface(pairs[q])) continue;
    const PairSide<Dim> a = side_of(groups, pairs[q].a), b = side_of(groups, pairs[q].b);
    const Vec<Dim> J = (pairs[q].w_settled - (b.v - a.v)) * reduced_mass(a, b);
    if (!a.rigid) for_groups(pairs[q].a, [&](int g) { groups[g].drift -= J * (1 / a.m); });
    if (!b.rigid) for_groups(pairs[q].b, [&](int g) { groups[g].drift += J * (1 / b.m); });
  }
}

/// What rigid bodies give to the others: work at the boundary, and in Task 4 the force.
template <int Dim>
void book_rigid(const ContactGroup<Dim>& group, const RigidPose<Dim>& pose, const Vec<Dim>& x, double taken, ContactTask task, double dt,
                BlockLedger<Dim>& ledger) {
  ledger.boundary_work += taken;
  if (task != ContactTask::four || group.dp == Vec<Dim>{}) return;
  auto at = std::find_if(ledger.rigid.begin(), ledger.rigid.end(), [&](const auto& r) { return r.body == group.body; });
  if (at == ledger.rigid.end()) at = ledger.rigid.insert(ledger.rigid.end(), {static_cast<std::uint16_t>(group.body), {}});
  const Vec<Dim> F = group.dp * (-1 / dt), r = x - pose.centre;
  at->on_material.force += F;
  at->on_material.torque[2] += r[0] * F[1] - r[1] * F[0];
  if constexpr (Dim == 3) {
    at->on_material.torque[0] += r[1] * F[2] - r[2] * F[1];
    at->on_material.torque[1] += r[2] * F[0] - r[0] * F[2];
  }
}

/// What particles are to add to their memory of contact waits on the nodes in the place of the contact sums, which have done their work:
/// {gain, 1} where there is contact, else zeros.
template <int Dim>
void forget_gains(State<Dim>& state, std::size_t b) {
  const std::size_t count = state.nodes.layers[b].node.size() * block_nodes<Dim>;
  for (std::size_t i = 0; i < count; ++i) state.nodes.contact[state.nodes.layers[b].slot(0, 0) + i].r[0] = splat(0.);
}
template <int Dim>
void put_gain(State<Dim>& state, std::size_t b, const ContactNode<Dim>& node, const ContactPair<Dim>& pair) {
  if (!needs_history(*pair.law) || (pair.state == ContactState::open && !holds_as_interface(pair))) return;
  const ContactNodes<Dim>& contacts = state.scratch[b].contact;
  for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
    if (pair.a & only(contacts.fields[f].group))
      state.nodes.contact[state.nodes.layers[b].slot(contacts.fields[f].layer, node.node)].r[0] = Pack{pair.history_gain, 1., 0., 0.};
  }
}

ContactRules rules_of(const auto& contact, ContactTask task, double dt) {
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
  return rules;
}

}  // namespace

template <int Dim>
void adjust_contact(State<Dim>& state, const Model<Dim>& model, std::size_t b, ContactTask task, double dt) {
  ContactNodes<Dim>& contacts = state.scratch[b].contact;
  const bool remembers = task == ContactTask::four && state.particles.contact.size() > 0;
  if (remembers) forget_gains(state, b);
  if (contacts.nodes.empty()) return;
  Nodes<Dim>& nodes = state.nodes;
  BlockLedger<Dim>& ledger = state.scratch[b].ledger;
  ContactRules rules = rules_of(model.contact, task, dt);
  const bool re_extrapolates = model.transfer_in(state.step).re_extrapolates;
  rules.hold = 0.25 * model.grid.smallest_cell();  // well above what gaps err by (docs/theory/contact.md, detection)
  std::vector<Vec<Dim>> before;
  for (ContactNode<Dim>& node : contacts.nodes) {
    ContactGroup<Dim>* groups = contacts.groups.data() + node.first_group;
    ContactPair<Dim>* pairs = contacts.pairs.data() + node.first_pair;
    const int group_count = static_cast<int>(node.end_group - node.first_group);
    const int pair_count = static_cast<int>(node.end_pair - node.first_pair);
    for (int g = 0; g < group_count; ++g) groups[g].p = groups[g].dp = {};
    for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
      groups[contacts.fields[f].group].p += momentum_of(nodes, state.nodes.layers[b].slot(contacts.fields[f].layer, node.node));
    }
    const Vec<Dim> x_i = model.grid.node_position(state.blocks.list[b].node(node.node));
    for (int g = 0; g < group_count; ++g) {
      if (!groups[g].wall) continue;
      const RigidMotion<Dim>& motion = state.rigid[static_cast<std::size_t>(groups[g].body)];
      if (task != ContactTask::term) groups[g].p = (task == ContactTask::two ? motion.start : motion.end).velocity_at(x_i) * groups[g].m;
    }
    // Prescribed components stay in Task 4 (N13 sec. 2.5), and in the other tasks where nothing imposes them again after contact.
    const bool imposed_before =
        task == ContactTask::four || task == ContactTask::term || model.boundary_order == BoundaryOrder::boundary_first;
    rules.fixed_axes = imposed_before ? fixed_axes(state, b, node.node) : 0u;
    if (pair_count > 0) {
      before.clear();
      for (int g = 0; g < group_count; ++g) before.push_back(groups[g].velocity());
      double rubbed = 0;
      for (int q = 0; q < pair_count; ++q) {
        if (task == ContactTask::two) pairs[q].w_start = relative_velocity(groups, pairs[q]);
        if (task == ContactTask::six) rubbed += friction_work(pairs[q], relative_velocity(groups, pairs[q]));
      }
      if (!solve_contact<Dim>(rules, groups, group_count, pairs, pair_count)) ++ledger.unsolved_nodes;
      double taken = 0;
      for (int g = 0; g < group_count; ++g) {
        const double by_group = energy_taken(groups[g], task, before[static_cast<std::size_t>(g)], re_extrapolates);
        taken += by_group;
        if (groups[g].rigid)
          book_rigid(groups[g], state.rigid[static_cast<std::size_t>(groups[g].body)].start, x_i, by_group, task, dt, ledger);
      }
      if (task == ContactTask::two) settle_pairs(groups, pairs, pair_count);
      if (task == ContactTask::six) find_drift(groups, pairs, pair_count);
      for (int q = 0; q < pair_count && task == ContactTask::four; ++q) {
        pairs[q].rubbing = rubbing(pairs[q]);
        // Without Task 6 the velocity of the particles at the end is not known: that at the start stands for both.
        if (!re_extrapolates) rubbed += friction_work(pairs[q], pairs[q].w_start);
        close_pair(groups, pairs[q], dt, ledger);
        if (remembers) put_gain(state, b, node, pairs[q]);
      }
      ledger.contact_loss += taken - rubbed;
      ledger.friction_loss += rubbed;
    }
    for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
      // Every field of a group takes the group's velocity (bonded: N13's stick) and its share, by mass, of the group's impulse.
      const std::size_t i = state.nodes.layers[b].slot(contacts.fields[f].layer, node.node);
      const ContactGroup<Dim>& group = groups[contacts.fields[f].group];
      if (group.rigid) continue;
      const double fraction = nodes.momentum[i][Dim] / group.m;
      Vec<Dim> dp = group.dp * fraction;
      if (fraction < 1) dp += group.p * fraction - momentum_of(nodes, i);
      for (int k = 0; k < Dim; ++k) {
        if (rules.fixed_axes >> k & 1u) dp[k] = 0;
      }
      if (task == ContactTask::six && group.drift != Vec<Dim>{})
        contacts.drifts.push_back({i, without_axes(group.drift, rules.fixed_axes)});
      if (task == ContactTask::four) {
        add_momentum_and_force(nodes, i, dp, dt);
      } else {
        add_momentum(nodes, i, dp);
      }
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM) template void adjust_contact<DIM>(State<DIM>&, const Model<DIM>&, std::size_t, ContactTask, double);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
