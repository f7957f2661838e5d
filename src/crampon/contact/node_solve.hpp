#pragma once
/// Contact at one node: its velocity fields, joined where bonded, and the pairs of them that face each other across a crack or as
/// different materials. docs/theory/contact.md for the impulses and for when they act.

#include <bit>
#include <cstdint>
#include <vector>

#include "crampon/contact/account.hpp"
#include "crampon/contact/law.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/state/contact_memory.hpp"
#include "crampon/state/layers.hpp"

namespace crampon {

/// One velocity field of a node.
struct ContactField {
  int layer = 0;  ///< of the node's block
  int group = 0;  ///< among the node's groups: fields joined by bonded cracks or materials share one velocity (conventions 13, 14)
};

/// Fields that share a velocity.
template <int Dim>
struct ContactGroup {
  double m = 0;        ///< kg; of a rigid body anything above zero
  Vec<Dim> p;          ///< kg m/s
  Vec<Dim> dp;         ///< impulse of the present task, kg m/s
  bool rigid = false;  ///< moves at p/m whatever befalls it (N13 Eqs. 13-16); dp is what the others give to it
  int body = -1;       ///< rigid: which body

  ContactAccount<Dim> account;
  Vec<Dim> drift;  ///< velocity of positions over that of strains, m/s: interfaces alone

  Vec<Dim> velocity() const { return rigid ? p * (1 / m) : (p + dp) * (1 / m); }
};

/// Some groups of a node, one bit each.
using GroupSet = std::uint64_t;
inline constexpr int most_groups = 64;
inline constexpr GroupSet only(int group) { return GroupSet{1} << group; }

/// f(index of a group) for every group of a set.
template <class F>
void for_groups(GroupSet set, F f) {
  for (; set != 0; set &= set - 1) f(std::countr_zero(set));
}

/// Two sides that face each other across one crack or as different materials; n points from a to b, across a crack from above to below.
/// A side of several groups (all materials on one side of a crack; N13's virtual material) meets the other with its common velocity and
/// shares impulses by mass.
template <int Dim>
struct ContactPair {
  GroupSet a = 0, b = 0;
  ContactName name;
  const ContactLaw* law = nullptr;
  Vec<Dim> n;
  double gap = 0;                              ///< m, at the start of the step: negative when they overlap
  double volume_ratio = 0;                     ///< V_rel of N03 Eq. 10
  double area = 0;                             ///< A, m2, where the law asks for it
  double history = 0;                          ///< what particles remember of it: distance slipped, m, or 1 where an interface failed
  double history_gain = 0;                     ///< in this step
  Vec<Dim> opening;                            ///< displacement of b against a since the start, m, where the law asks for it
  Vec<Dim> w_settled;                          ///< relative velocity after Task 2, m/s
  ContactState previous = ContactState::open;  ///< Task-4 state of the last step
  ContactState state = ContactState::open;     ///< Task-4 state of this step
  double met_at = 0;                           ///< relative speed that Task 2 has stopped, m/s
  bool stuck = false;                          ///< Task 2 has stopped all slip
  bool by_gap = false;                         ///< a rigid face: has no volume to go by
  double w_end = 0;                            ///< normal relative velocity right after the impulse of Task 4, m/s
  Vec<Dim> J;                                  ///< impulse on b in the present task, kg m/s
  Vec<Dim> w_start;                            ///< relative velocity before Task 2: of the particles about the node, m/s
  Vec<Dim> rubbing;                            ///< impulse of friction on b in Task 4, kg m/s

  bool is_virtual() const { return name.field_b == ContactName::all_others; }
};

template <int Dim>
struct ContactNode {
  std::uint16_t node = 0;   ///< local node of the block
  std::int64_t number = 0;  ///< node number in the grid
  std::uint32_t first_field = 0, end_field = 0;
  std::uint32_t first_group = 0, end_group = 0;
  std::uint32_t first_pair = 0, end_pair = 0;
};

/// Positions at a node move faster than strains by dv.
template <int Dim>
struct ContactDrift {
  std::size_t slot = 0;  ///< of the node in a field
  Vec<Dim> dv;           ///< m/s
};

/// All nodes of a block that hold more than one velocity field. Built in Task 2 and used again in Tasks 4 and 6: masses, normals,
/// gaps and volumes are those of Task 1.
template <int Dim>
struct ContactNodes {
  std::vector<ContactNode<Dim>> nodes;
  std::vector<ContactField> fields;
  std::vector<ContactGroup<Dim>> groups;
  std::vector<ContactPair<Dim>> pairs;
  std::vector<NodeSide> sides;
  std::vector<ContactDrift<Dim>> drifts;  ///< of Task 6
  void clear() {
    nodes.clear();
    fields.clear();
    groups.clear();
    pairs.clear();
    sides.clear();
    drifts.clear();
  }
};

/// How pairs are handled, the same for all nodes of a run.
struct ContactRules {
  ContactTask task = ContactTask::two;
  double dt = 0;  ///< s
  bool literal = false;
  /// consistent: a contact that was closed stays so while its gap reads no more than this, m. Without the bound a node that holds next to
  /// no mass, which one step drives through any gap, would go on pushing on a body that is not there.
  double stays_closed_within = HUGE_VAL;
  bool volume_for_cracks = false, volume_for_materials = false;  ///< literal: detection by relative volume (N03 section 2.2)
  double volume_separated = 0.9, volume_contact = 1.1;
  bool require_approach = true;
  bool sequential = false;
  unsigned fixed_axes = 0;  ///< bit k: component k of the node is prescribed and not changed (N13 sec. 2.5)

  bool by_volume(const ContactName& name) const { return name.between_materials() ? volume_for_materials : volume_for_cracks; }
};

/// A side of a pair as it moves now.
template <int Dim>
struct PairSide {
  double m = 0;  ///< kg
  Vec<Dim> v;    ///< m/s
  bool rigid = false;
};
template <int Dim>
PairSide<Dim> side_of(const ContactGroup<Dim>* groups, GroupSet set) {
  if (std::has_single_bit(set)) {
    const ContactGroup<Dim>& g = groups[std::countr_zero(set)];
    return {g.m, g.velocity(), g.rigid};
  }
  PairSide<Dim> side;
  for_groups(set, [&](int i) {
    side.m += groups[i].m;
    side.v += groups[i].p + groups[i].dp;
  });
  side.v *= 1 / side.m;
  return side;
}

/// m_red of two sides (N13 Eqs. 6, 16), kg.
template <int Dim>
double reduced_mass(const PairSide<Dim>& a, const PairSide<Dim>& b) {
  return a.rigid ? b.m : b.rigid ? a.m : a.m * b.m / (a.m + b.m);
}

/// Solves all pairs of one node: sets dp of every group (sum zero, kg m/s) and J, state and w_end of every pair. One pair, or pairs in
/// sequence, are done in one go; several together by sweeps over accumulated impulses until nothing changes by more than 1e-14 of the
/// momenta about (docs/decisions/0006-joint-contact.md). Pairs with N13's virtual material are done first and once, all from the same
/// momenta (conventions 35). Returns false when convergence was not reached. conventions 13.
template <int Dim>
bool solve_contact(const ContactRules& rules, ContactGroup<Dim>* groups, int group_count, ContactPair<Dim>* pairs, int pair_count);

}  // namespace crampon
