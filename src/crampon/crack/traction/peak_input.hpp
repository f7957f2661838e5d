#pragma once
/// What the input says of a curve of traction over opening: exactly two of strength, final opening and toughness.

#include <optional>

#include "crampon/core/declaration.hpp"

namespace crampon {

/// SI; what is left out follows from the others.
struct PeakInput {
  std::optional<double> strength, final_opening, toughness;
};

/// A curve that is elastic up to its peak: also where that is.
struct ElasticPeakInput : PeakInput {
  std::optional<double> peak_opening, stiffness;
};

/// Reports unless exactly two are given.
bool check_two_of_three(const PeakInput& in, Diagnostics& diagnostics);
/// Reports unless also the peak is given.
bool check_peak(const ElasticPeakInput& in, Diagnostics& diagnostics);
/// Reports unless before < after, two openings of the curve, m; each by its name.
bool check_order(const char* before_name, double before, const char* after_name, double after, Diagnostics& diagnostics);

/// Adds the keys of PeakInput.
template <class Input>
Declaration<Input> with_strength(Declaration<Input> d) {
  return d.quantity("strength", &Input::strength, "Pa", Bounds::positive(), "traction at the peak")
      .quantity("final_opening", &Input::final_opening, "m", Bounds::positive(), "opening at which the traction has vanished")
      .quantity("toughness", &Input::toughness, "J/m2", Bounds::positive(),
                "area under the curve; exactly two of strength, final_opening and toughness are given");
}

/// Adds the keys of ElasticPeakInput.
template <class Input>
Declaration<Input> with_elastic_peak(Declaration<Input> d) {
  return with_strength(std::move(d))
      .quantity("peak_opening", &Input::peak_opening, "m", Bounds::positive(), "opening at the end of the elastic part")
      .quantity("stiffness", &Input::stiffness, "Pa/m", Bounds::positive(),
                "slope of the elastic part, in place of peak_opening; 10 to 50 times Young's modulus over the cell size is enough")
      .excludes({"peak_opening"});
}

}  // namespace crampon
