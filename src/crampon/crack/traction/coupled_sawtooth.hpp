#pragma once
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/response.hpp"
#include "crampon/crack/traction/triangular.hpp"

namespace crampon {

struct CoupledSawtoothInput {
  TriangularInput normal, shear;
};

/// One triangular curve over an effective opening (docs/theory/traction.md; J. L. Hogberg, Int. J. Fract. 141 (2006) 549).
struct CoupledSawtooth {
  using Input = CoupledSawtoothInput;
  TriangularCurve normal, shear;

  static constexpr const char* name = "coupled_sawtooth";
  static constexpr bool acts = true;
  static constexpr bool acts_closed = false;
  static constexpr bool from_outside = false;
  static CoupledSawtooth make(const Input& in) { return {in.normal.curve(), in.shear.curve()}; }
  static std::vector<CoupledSawtooth> examples() { return {{TriangularInput::example().curve(), TriangularInput::example().curve()}}; }
  static const Declaration<Input>& declaration();
  Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) const;
  double largest_stiffness() const;
  PerMode toughness() const { return {normal.toughness(), shear.toughness()}; }
};

}  // namespace crampon
