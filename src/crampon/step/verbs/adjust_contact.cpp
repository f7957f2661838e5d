#include "crampon/step/verbs.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/step/contact_booking.hpp"
#include "crampon/step/fixed_components.hpp"

namespace crampon {

namespace {

template <int Dim>
Vec<Dim> momentum_of(const Nodes<Dim>& nodes, std::size_t i) {
  Vec<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = nodes.momentum[i][k];
  return p;
}

template <int Dim>
Vec<Dim> relative_velocity(const ContactGroup<Dim>* groups, const ContactPair<Dim>& pair) {
  return side_of(groups, pair.b).v - side_of(groups, pair.a).v;
}

template <int Dim>
void keep_relative_velocities(const ContactGroup<Dim>* groups, ContactPair<Dim>* pairs, int pair_count) {
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
  note_slip(pair, w, dt);
}

/// Interfaces are springs, and a spring opens with the relative velocity that Task 4 has found for its two sides. Positions must therefore
/// move with that velocity, although strains follow the velocities of Task 6. The drift of a group is the difference of the two. A spring
/// that is too stiff for the step is held and closes by a tenth in each step (docs/theory/contact.md, interfaces): the drift moves its
/// sides together, and no strain comes of it.
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

/// What particles are to add to their memory of contact waits on the nodes until they move (step/move_pass.cpp).
template <int Dim>
void put_gain(StepWork<Dim>& work, std::size_t b, const ContactNode<Dim>& node, const ContactPair<Dim>& pair) {
  if (!pair.law->needs_history() || (pair.state == ContactState::open && !holds_as_interface(pair))) return;
  const ContactNodes<Dim>& contacts = work.scratch[b].contact;
  for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
    if (pair.a & only(contacts.fields[f].group))
      work.nodes.contact_gain[work.nodes.layers[b].slot(contacts.fields[f].layer, node.node)] = Pack{pair.history_gain, 1., 0., 0.};
  }
}

/// For each group of the nodes of a block: what meets a rigid face there in some column, and was solved with it; null: nothing.
template <int Dim>
std::vector<const FaceGroup<Dim>*> groups_at_faces(const BlockScratch<Dim>& scratch) {
  std::vector<const FaceGroup<Dim>*> at_face(scratch.contact.groups.size(), nullptr);
  for (const FacePart<Dim>& part : scratch.face_nodes.parts) {
    const FaceGroup<Dim>& group = scratch.face_nodes.groups[part.group];
    if (part.w != 0 && group.contact_group >= 0) at_face[static_cast<std::size_t>(group.contact_group)] = &group;
  }
  return at_face;
}

}  // namespace

template <int Dim>
void adjust_contact(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, ContactTask task) {
  const double dt = work.now.dt;
  ContactNodes<Dim>& contacts = work.scratch[b].contact;
  const bool remembers = task == ContactTask::four && state.particles.contact.size() > 0;
  if (contacts.nodes.empty()) return;
  Nodes<Dim>& nodes = work.nodes;
  BlockLedger<Dim>& ledger = work.scratch[b].ledger;
  ContactRules rules = contact_rules(model, task, dt);
  const bool re_extrapolates = model.transfer_in(state.clock.step).re_extrapolates;
  std::vector<Vec<Dim>> before, given;
  const std::vector<const FaceGroup<Dim>*> at_face = groups_at_faces(work.scratch[b]);
  for (ContactNode<Dim>& node : contacts.nodes) {
    ContactGroup<Dim>* groups = contacts.groups.data() + node.first_group;
    const auto first_at_face = at_face.begin() + node.first_group;
    const bool is_solved = std::any_of(first_at_face, at_face.begin() + node.end_group, [](const auto* face) { return face != nullptr; });
    ContactPair<Dim>* pairs = contacts.pairs.data() + node.first_pair;
    const int group_count = static_cast<int>(node.end_group - node.first_group);
    const int pair_count = static_cast<int>(node.end_pair - node.first_pair);
    given.clear();
    for (int g = 0; g < group_count; ++g) {
      given.push_back(groups[g].dp);
      groups[g].p = groups[g].dp = {};
    }
    for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
      groups[contacts.fields[f].group].p += momentum_of(nodes, work.nodes.layers[b].slot(contacts.fields[f].layer, node.node));
    }
    const Vec<Dim> x_i = model.grid.node_position(work.blocks.list[b].node(node.node));
    rules.fixed_axes = fixes_before_contact(model, task) ? fixed_axes(work, b, node.node) : 0u;
    if (pair_count > 0) {
      before.clear();
      for (int g = 0; g < group_count; ++g) before.push_back(groups[g].velocity());
      double rubbed = 0;
      for (int q = 0; q < pair_count; ++q) {
        if (task == ContactTask::two) pairs[q].w_start = relative_velocity(groups, pairs[q]);
        if (task == ContactTask::six) rubbed += friction_work(pairs[q], relative_velocity(groups, pairs[q]));
      }
      if (is_solved) {
        for (int g = 0; g < group_count; ++g) {
          groups[g].dp = given[static_cast<std::size_t>(g)];
          // With what the faces give, for all that is judged by the velocities after contact.
          if (const FaceGroup<Dim>* face = first_at_face[g]) groups[g].p = face->v * groups[g].m - groups[g].dp;
        }
      } else if (!solve_contact<Dim>(rules, groups, group_count, pairs, pair_count)) {
        ++ledger.unsolved_nodes;
      }
      double taken = 0;
      for (int g = 0; g < group_count; ++g) {
        const double by_group =
            groups[g].account.book(task, before[static_cast<std::size_t>(g)], groups[g].dp, groups[g].velocity(), re_extrapolates);
        taken += by_group;
        if (!groups[g].rigid) continue;
        ledger.boundary_work += by_group;
        if (task == ContactTask::four)
          book_reaction(ledger, static_cast<std::uint16_t>(groups[g].body), state.rigid[static_cast<std::size_t>(groups[g].body)].start,
                        x_i, groups[g].dp * (-1 / dt));
      }
      if (task == ContactTask::two) keep_relative_velocities(groups, pairs, pair_count);
      if (task == ContactTask::six) find_drift(groups, pairs, pair_count);
      for (int q = 0; q < pair_count && task == ContactTask::four; ++q) {
        pairs[q].rubbing = rubbing(pairs[q]);
        // Without Task 6 the velocity of the particles at the end is not known: that at the start stands for both.
        if (!re_extrapolates) rubbed += friction_work(pairs[q], pairs[q].w_start);
        close_pair(groups, pairs[q], dt, ledger);
        if (remembers) put_gain(work, b, node, pairs[q]);
      }
      ledger.contact_loss += taken - rubbed;
      ledger.friction_loss += rubbed;
      for (int g = 0; g < group_count; ++g) {
        if (first_at_face[g]) groups[g].p = before[static_cast<std::size_t>(g)] * groups[g].m;
      }
    }
    for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
      // Every field of a group takes the group's velocity (bonded: N13's stick) and its share, by mass, of the group's impulse.
      const std::size_t i = work.nodes.layers[b].slot(contacts.fields[f].layer, node.node);
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
      change_node(nodes, i, dp, task, dt);
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM) \
  template void adjust_contact<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t, ContactTask);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
