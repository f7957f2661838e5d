#include "crampon/crack/traction/cubic.hpp"

namespace crampon {

CubicCurve CubicInput::curve() const {
  return {strength ? *strength : *toughness / (0.5625 * *final_opening),
          final_opening ? *final_opening : *toughness / (0.5625 * *strength)};
}

CubicInput CubicInput::example() {
  CubicInput in;
  in.strength = 5e6, in.toughness = 300;
  return in;
}

const Declaration<CubicInput>& CubicInput::declaration() {
  static const auto d =
      with_strength(Declaration<CubicInput>(name, "Smooth: 27/4 strength s (1 - s)^2 with s = opening/final_opening; peak at s = 1/3."))
          .check([](const CubicInput& in, Diagnostics& diagnostics) { check_two_of_three(in, diagnostics); });
  return d;
}

}  // namespace crampon
