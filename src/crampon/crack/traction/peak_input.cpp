#include "crampon/crack/traction/peak_input.hpp"

#include <fmt/format.h>

namespace crampon {

bool check_two_of_three(const PeakInput& in, Diagnostics& diagnostics) {
  const char* const why = "exactly two of strength, final_opening and toughness define the curve";
  const int given = int(in.strength.has_value()) + int(in.final_opening.has_value()) + int(in.toughness.has_value());
  if (given == 3) diagnostics.add("toughness", "strength, final_opening and toughness are all given", why, "remove one of them");
  if (given == 1) {
    const char* const only = in.strength ? "strength" : in.final_opening ? "final_opening" : "toughness";
    diagnostics.add(only, fmt::format("of the curve only {} is given", only), why, "add one of the others");
  }
  if (given == 0) diagnostics.add("", "the curve has no size", why, "add strength = ... and toughness = ...");
  return given == 2;
}

bool check_peak(const ElasticPeakInput& in, Diagnostics& diagnostics) {
  const bool sized = check_two_of_three(in, diagnostics), peaked = in.peak_opening || in.stiffness;
  if (!peaked)
    diagnostics.add("", "neither stiffness nor peak_opening is given", "the curve is elastic up to its peak", "add stiffness = ...");
  return sized && peaked;
}

bool check_order(const char* before_name, double before, const char* after_name, double after, Diagnostics& diagnostics) {
  if (before < after) return true;
  diagnostics.add("", fmt::format("the {} is not below the {}", before_name, after_name), fmt::format("{:g} m and {:g} m", before, after),
                  "correct strength, toughness, openings or stiffness");
  return false;
}

}  // namespace crampon
