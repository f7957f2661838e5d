#pragma once
#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/response.hpp"
#include "crampon/crack/traction/triangular.hpp"

namespace crampon {

/// One triangular curve over an effective opening (docs/theory/traction.md; J. L. Hogberg, Int. J. Fract. 141 (2006) 549).
struct CoupledSawtooth {
  TriangularCurve normal, shear;

  static constexpr bool acts_closed = false;
  Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) const;
  double largest_stiffness() const;
  PerMode toughness() const { return {normal.toughness(), shear.toughness()}; }
};

struct CoupledSawtoothInput {
  TriangularInput normal, shear;
  static const Declaration<CoupledSawtoothInput>& declaration();
};

}  // namespace crampon
