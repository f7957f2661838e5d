#include "crampon/crack/traction/elastic_brittle.hpp"

namespace crampon {

BrittleCurve BrittleInput::curve() const {
  return {strength ? *strength : 2 * *toughness / *final_opening, final_opening ? *final_opening : 2 * *toughness / *strength};
}

const Declaration<BrittleInput>& BrittleInput::declaration() {
  static const auto d = with_strength(Declaration<BrittleInput>("elastic_brittle", "Straight up to the strength, then nothing."))
                            .check([](const BrittleInput& in, Diagnostics& diagnostics) { check_two_of_three(in, diagnostics); });
  return d;
}

}  // namespace crampon
