#include "crampon/crack/traction/elastic_brittle.hpp"

namespace crampon {

BrittleCurve BrittleInput::curve() const {
  return {strength ? *strength : 2 * *toughness / *final_opening, final_opening ? *final_opening : 2 * *toughness / *strength};
}

BrittleInput BrittleInput::example() {
  BrittleInput in;
  in.strength = 5e6, in.toughness = 300;
  return in;
}

const Declaration<BrittleInput>& BrittleInput::declaration() {
  static const auto d = with_strength(Declaration<BrittleInput>(name, "Straight up to the strength, then nothing."))
                            .check([](const BrittleInput& in, Diagnostics& diagnostics) { check_two_of_three(in, diagnostics); });
  return d;
}

}  // namespace crampon
