#include "crampon/crack/traction/triangular.hpp"

namespace crampon {

TriangularCurve TriangularInput::curve() const {
  const double sigma_c = strength ? *strength : 2 * *toughness / *final_opening;
  return {sigma_c, peak_opening ? *peak_opening : sigma_c / *stiffness, final_opening ? *final_opening : 2 * *toughness / sigma_c};
}

TriangularInput TriangularInput::example() {
  TriangularInput in;
  in.strength = 5e6, in.toughness = 300, in.peak_opening = 1e-5;
  return in;
}

const Declaration<TriangularInput>& TriangularInput::declaration() {
  static const auto d =
      with_elastic_peak(Declaration<TriangularInput>(name, "Straight up to the strength, straight down to nothing (sawtooth)."))
          .check([](const TriangularInput& in, Diagnostics& diagnostics) {
            if (!check_peak(in, diagnostics)) return;
            const TriangularCurve c = in.curve();
            check_order("opening at the peak", c.peak_opening, "final opening", c.last_opening, diagnostics);
          });
  return d;
}

}  // namespace crampon
