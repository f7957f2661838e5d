#pragma once
/// What a contact remembers from one step to the next: open, slip or stick (docs/theory/contact.md, the scheme).

#include <algorithm>
#include <compare>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "crampon/core/members.hpp"
#include "crampon/state/layers.hpp"

namespace crampon {

enum class ContactState : std::uint8_t { open, slip, stick };

/// A contact at a node, named by what does not change when a crack drifts across the node. Faces of a crack: the crack and the other
/// cracks that separate both from the node; of several cracks with nothing between them: the first and the rest. Two materials: their
/// fields and the cracks that separate both from the node.
struct ContactName {
  static constexpr CrackId no_crack = 0xffffffffu;
  static constexpr std::uint16_t all_others = 0xffff;  ///< the virtual material of N13 Eq. 8

  CrackId crack = no_crack;
  std::uint16_t field_a = 0, field_b = 0;  ///< material fields, of those that are bonded the lowest; 0 for faces of a crack
  Signature others;
  Signature rest;         ///< cracks between the two besides `crack`
  std::uint8_t face = 0;  ///< 1 and more: of a corner in which one body meets the other by several faces
  bool between_materials() const { return crack == no_crack; }
  auto operator<=>(const ContactName&) const = default;

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [crack, field_a, field_b, others, rest, face] = self;
    visit(Member{"crack"}, crack);
    visit(Member{"field_a"}, field_a);
    visit(Member{"field_b"}, field_b);
    visit(Member{"others"}, others);
    visit(Member{"rest"}, rest);
    visit(Member{"face"}, face);
  }
};

struct ContactKey {
  std::int64_t node = 0;
  ContactName name;
  auto operator<=>(const ContactKey&) const = default;

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [node, name] = self;
    visit(Member{"node"}, node);
    visit(Member{"name"}, name);
  }
};

/// On which side of a crack a node lay.
struct NodeSide {
  std::int64_t node = 0;
  CrackId crack = 0;
  std::int8_t side = 0;  ///< of the particles across: +1 above, -1 below
  auto key() const { return std::pair{node, crack}; }

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [node, crack, side] = self;
    visit(Member{"node"}, node);
    visit(Member{"crack"}, crack);
    visit(Member{"side"}, side);
  }
};

/// Sorted by key; entries that are not there were open.
struct ContactMemory {
  struct Entry {
    ContactKey key;
    ContactState state = ContactState::open;

    template <class Self, class Visit>
    static void for_members(Self& self, Visit&& visit) {
      auto& [key, state] = self;
      visit(Member{"key"}, key);
      visit(Member{"state"}, state);
    }
  };
  std::vector<Entry> entries;
  std::vector<NodeSide> sides;
  std::unordered_map<std::int64_t, double> initial_volume;  ///< by node number: of the uncut body at the start, m2 or m3 (conventions 10)

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [entries, sides, initial_volume] = self;
    visit(Member{"entries"}, entries);
    visit(Member{"sides"}, sides);
    visit(Member{"initial_volume", "m2 or m3"}, initial_volume);
  }

  ContactState find(const ContactKey& key) const {
    const auto at = std::lower_bound(entries.begin(), entries.end(), key, [](const Entry& e, const ContactKey& k) { return e.key < k; });
    return at != entries.end() && at->key == key ? at->state : ContactState::open;
  }
  /// 0 when the node was not beside the crack.
  std::int8_t side(std::int64_t node, CrackId crack) const {
    const std::pair key{node, crack};
    const auto at = std::lower_bound(sides.begin(), sides.end(), key, [](const NodeSide& s, const auto& k) { return s.key() < k; });
    return at != sides.end() && at->key() == key ? at->side : std::int8_t{0};
  }
  void sort() {
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
    std::sort(sides.begin(), sides.end(), [](const NodeSide& a, const NodeSide& b) { return a.key() < b.key(); });
  }
};

}  // namespace crampon
