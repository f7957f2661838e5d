#pragma once
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// Slip without resistance.
struct FrictionlessContact {
  static constexpr const char* name = "frictionless";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = false;
  static std::vector<FrictionlessContact> examples() { return {FrictionlessContact{}}; }
  bool needs_area() const { return false; }
  Remembered remembers() const { return Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::overlap}; }
  SlidingLimit limit(const Sliding&) const { return {}; }

  static const Declaration<FrictionlessContact>& declaration() {
    static const auto d = Declaration<FrictionlessContact>(name, "The two do not interpenetrate and slip without resistance.");
    return d;
  }
};

}  // namespace crampon
