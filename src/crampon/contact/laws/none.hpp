#pragma once
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// The two do not see each other.
struct NoContact {
  static constexpr const char* name = "none";
  static constexpr Meeting meeting = Meeting::never;
  static constexpr bool adheres = false;
  static std::vector<NoContact> examples() { return {NoContact{}}; }
  bool needs_area() const { return false; }
  Remembered remembers() const { return Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::nothing}; }
  SlidingLimit limit(const Sliding&) const { return {}; }

  static const Declaration<NoContact>& declaration() {
    static const auto d = Declaration<NoContact>(name, "The two pass through each other.");
    return d;
  }
};

}  // namespace crampon
