#pragma once
/// Contact at one node: its velocity fields, joined where bonded, and the pairs of them that face each other across a crack.
/// contact.md section 3 for the impulses, contact-consistency.md for when they act.

#include <cstdint>
#include <vector>

#include "crampon/contact/law.hpp"
#include "crampon/contact/memory.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/state/layers.hpp"

namespace crampon {

/// One velocity field of a node.
struct ContactField {
  int layer = 0;  ///< of the node's block
  int group = 0;  ///< among the node's groups: fields joined by bonded cracks share one velocity (CONVENTIONS 13, 14)
};

/// Fields that share a velocity. m in kg, p in kg m/s.
template <int Dim>
struct ContactGroup {
  double m = 0;
  Vec<Dim> p;
  Vec<Dim> dp;  ///< impulse of the present task
};

/// Two groups that face each other across one crack; n points from a (above) to b (below).
template <int Dim>
struct ContactPair {
  int a = 0, b = 0;
  CrackId crack = 0;
  Signature others;  ///< the other cracks that separate the pair from the node
  Vec<Dim> n;
  double gap = 0;                              ///< m, at the start of the step: negative when the faces overlap (contact.md 2.2)
  double volume_ratio = 0;                     ///< V_rel of N03 Eq. 10
  ContactState previous = ContactState::open;  ///< Task-4 state of the last step
  ContactState state = ContactState::open;     ///< Task-4 state of this step
  double w_end = 0;                            ///< normal relative velocity right after the impulse of Task 4, m/s
  Vec<Dim> J;                                  ///< impulse on b in the present task, kg m/s

  // For the energy that contact takes (BlockLedger::contact_loss).
  Vec<Dim> w_start;    ///< relative velocity before Task 2, m/s
  Vec<Dim> w_settled;  ///< ... after it
  Vec<Dim> gain;       ///< what the forces of Task 3 added to it
  Vec<Dim> J2, J4;     ///< impulses of Tasks 2 and 4, kg m/s
};

template <int Dim>
struct ContactNode {
  std::uint16_t node = 0;   ///< local node of the block
  std::int64_t number = 0;  ///< node number in the grid
  std::uint32_t first_field = 0, end_field = 0;
  std::uint32_t first_group = 0, end_group = 0;
  std::uint32_t first_pair = 0, end_pair = 0;
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
  void clear() {
    nodes.clear();
    fields.clear();
    groups.clear();
    pairs.clear();
    sides.clear();
  }
};

enum class ContactTask { two, four, six };

/// How pairs are handled, the same for all nodes of a run.
struct ContactRules {
  ContactTask task = ContactTask::two;
  double dt = 0;  ///< s
  bool literal = false;
  bool by_volume = false;
  double volume_separated = 0.9, volume_contact = 1.1;
  bool require_approach = true;
  bool sequential = false;
  unsigned fixed_axes = 0;  ///< bit k: component k of the node is prescribed and not changed (N13 sec. 2.5)
};

/// Solves all pairs of one node: sets dp of every group (sum zero, kg m/s) and J, state and w_end of every pair. One pair, or pairs in
/// sequence, are done in one go; several together by sweeps over accumulated impulses until nothing changes by more than 1e-14 of the
/// momenta about (docs/decisions/0006-joint-contact.md). Returns false when that was not reached. CONVENTIONS 13.
template <int Dim>
bool solve_contact(const ContactRules& rules, const std::vector<ContactLawSpec>& laws, ContactGroup<Dim>* groups, int group_count,
                   ContactPair<Dim>* pairs, int pair_count);

}  // namespace crampon
