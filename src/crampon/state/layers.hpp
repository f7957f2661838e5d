#pragma once
/// Velocity fields. A layer is the set of particle-node pairs of one material field whose connecting lines cross the same cracks
/// (docs/theory/space.md, layers): {} is N13's field [0], {a} its [1], {b} its [2], {a, b} its [3]. Three and more cracks at a node are no
/// special case.

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "crampon/core/members.hpp"

namespace crampon {

using CrackId = std::uint32_t;

/// The cracks that a line from a particle to a node crosses, ascending.
class Signature {
 public:
  static constexpr int capacity = 7;

  bool empty() const { return size_ == 0; }
  int size() const { return static_cast<int>(size_); }
  CrackId operator[](int k) const { return cracks_[k]; }
  const CrackId* begin() const { return cracks_.data(); }
  const CrackId* end() const { return cracks_.data() + size_; }
  bool contains(CrackId c) const { return std::find(begin(), end(), c) != end(); }

  /// Cracks must be added in ascending order. False when more than `capacity` cracks would be held.
  bool append(CrackId c) {
    if (size_ == capacity) return false;
    cracks_[size_++] = c;
    return true;
  }
  /// The same in any order, for a crack that it does not contain.
  bool insert(CrackId c) {
    if (size_ == capacity) return false;
    toggle(c);
    return true;
  }
  /// Present becomes absent and the other way round.
  void toggle(CrackId c) {
    auto* at = std::lower_bound(cracks_.data(), cracks_.data() + size_, c);
    if (at != end() && *at == c) {
      std::copy(at + 1, cracks_.data() + size_, at);
      cracks_[--size_] = 0;
    } else if (size_ < capacity) {
      std::copy_backward(at, cracks_.data() + size_, cracks_.data() + size_ + 1);
      *at = c;
      ++size_;
    }
  }
  /// Those that b does not hold.
  Signature without(const Signature& b) const {
    Signature out;
    for (const CrackId c : *this) {
      if (!b.contains(c)) out.append(c);
    }
    return out;
  }
  auto operator<=>(const Signature& b) const = default;
  bool operator==(const Signature& b) const { return std::equal(begin(), end(), b.begin(), b.end()); }  // most hold none or one

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [size, cracks] = self;
    visit(Member{"size"}, size);
    visit(Member{"cracks"}, cracks);
  }

 private:
  std::uint32_t size_ = 0;  // first: shorter signatures sort first, {} before all
  std::array<CrackId, capacity> cracks_{};
};

/// By how many cracks two signatures differ.
inline int differences(const Signature& a, const Signature& b) { return a.without(b).size() + b.without(a).size(); }

/// A velocity field of a block: one material field (N13 sec. 1.2) on one side of the cracks.
struct Layer {
  std::uint16_t field = 0;  ///< material field
  Signature cracks;
  auto operator<=>(const Layer& b) const = default;
};

/// Where the pair (particle, node) of a particle near a crack, a symmetry plane or a held face goes.
struct PairTarget {
  std::uint16_t node = 0;     ///< tile index; the mirror node when the pair is folded
  std::uint8_t layer = 0;     ///< of the block
  std::uint8_t flip = 0;      ///< bit k: component k changes sign in the exchange (conventions 29)
  std::uint8_t mirrored = 0;  ///< bit k: the mirror node is on the other side of a plane across axis k
  std::uint8_t held = 0;      ///< 1: folded at a face of prescribed velocity
  std::uint16_t offset = 0;   ///< index into the block's offsets: what is read at the mirror node, its signs changed, plus this
};

}  // namespace crampon
