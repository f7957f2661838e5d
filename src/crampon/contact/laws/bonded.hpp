#pragma once
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// Joined for good: no detection, equal to a body without the boundary (conventions 44).
struct BondedContact {
  static constexpr const char* name = "bonded";
  static constexpr Meeting meeting = Meeting::joined;
  static constexpr bool adheres = false;
  static std::vector<BondedContact> examples() { return {BondedContact{}}; }
  bool needs_area() const { return false; }
  Remembered remembers() const { return Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::everything}; }
  SlidingLimit limit(const Sliding&) const { return SlidingLimit::stick(); }

  static const Declaration<BondedContact>& declaration() {
    static const auto d = Declaration<BondedContact>(name, "Joined for good, as if there were no boundary between the two.");
    return d;
  }
};

}  // namespace crampon
