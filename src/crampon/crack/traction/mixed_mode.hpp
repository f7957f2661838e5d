#pragma once
#include <variant>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/cubic.hpp"
#include "crampon/crack/traction/exponential.hpp"
#include "crampon/crack/traction/response.hpp"
#include "crampon/crack/traction/triangular.hpp"
#include "crampon/crack/traction/trilinear.hpp"

namespace crampon {

/// A curve with an inverse: opening over damage.
using SofteningCurve = std::variant<TriangularCurve, TrilinearCurve, CubicCurve, ExponentialCurve>;

/// As the input sees it: { curve = "cubic", strength = "5 MPa", toughness = "300 J/m2" }.
const Family<SofteningCurve>& softening_curves();

/// Any two curves, one damage variable (docs/theory/traction.md). The tractions stay on the ellipse (T_n/S_n)^2 + (T_t/S_t)^2 = 1.
struct MixedModeTraction {
  SofteningCurve normal, shear;

  using Input = MixedModeTraction;
  static constexpr const char* name = "mixed_mode";
  static constexpr bool acts = true;
  static constexpr bool acts_closed = false;
  static constexpr bool from_outside = false;
  static MixedModeTraction make(const Input& input) { return input; }
  static std::vector<MixedModeTraction> examples();
  Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) const;
  double largest_stiffness() const;
  PerMode toughness() const;
  static const Declaration<MixedModeTraction>& declaration();
};

}  // namespace crampon
