#pragma once
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// No slip while in contact and in compression; free to open.
struct StickContact {
  static constexpr const char* name = "stick";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = false;
  static std::vector<StickContact> examples() { return {StickContact{}}; }
  bool needs_area() const { return false; }
  Remembered remembers() const { return Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::slip}; }
  SlidingLimit limit(const Sliding&) const { return SlidingLimit::stick(); }

  static const Declaration<StickContact>& declaration() {
    static const auto d = Declaration<StickContact>(name, "No slip while the two press on each other; free to open.");
    return d;
  }
};

}  // namespace crampon
