#pragma once
/// Tractions between the faces of a crack that is not yet torn apart, or that a fluid fills: cohesive zones, bridging fibres, pressure
/// (docs/theory/traction.md). A law is a small value type with acts_closed, respond(), largest_stiffness() and toughness(); adding one:
/// its file, one entry in TractionLawSpec and one in traction_laws().

#include <variant>

#include "crampon/crack/traction/coupled_sawtooth.hpp"
#include "crampon/crack/traction/cubic.hpp"
#include "crampon/crack/traction/decoupled.hpp"
#include "crampon/crack/traction/elastic_brittle.hpp"
#include "crampon/crack/traction/exponential.hpp"
#include "crampon/crack/traction/linear_elastic.hpp"
#include "crampon/crack/traction/mixed_mode.hpp"
#include "crampon/crack/traction/pressure.hpp"
#include "crampon/crack/traction/triangular.hpp"
#include "crampon/crack/traction/trilinear.hpp"
#include "crampon/crack/traction/user_curve.hpp"

namespace crampon {

/// The faces are free.
struct NoTraction {
  static constexpr bool acts_closed = false;
  Traction respond(const PerMode&, double, const Vec<3>&, TractionHistory&) const { return {}; }
  double largest_stiffness() const { return 0; }
  PerMode toughness() const { return {}; }
  static const Declaration<NoTraction>& declaration();
};

using TriangularTraction = DecoupledTraction<TriangularCurve>;
using TrilinearTraction = DecoupledTraction<TrilinearCurve>;
using CubicTraction = DecoupledTraction<CubicCurve>;
using ExponentialTraction = DecoupledTraction<ExponentialCurve>;
using UserCurveTraction = DecoupledTraction<UserCurve>;
using BrittleTraction = DecoupledTraction<BrittleCurve>;

using TractionLawSpec =
    std::variant<NoTraction, TriangularTraction, TrilinearTraction, CubicTraction, ExponentialTraction, UserCurveTraction, BrittleTraction,
                 CoupledSawtooth, MixedModeTraction, LinearElasticTraction, PressureTraction>;

/// The family as the input sees it: `traction = { law = "cubic", normal = { ... }, shear = { ... } }`.
const Family<TractionLawSpec>& traction_laws();

/// Takes one vertex to the end of a step; to be called once for each step. opening: of the faces at its end, m. time (s) and x, the
/// place of the vertex (m), matter to pressure alone. Tractions are those at the end of the step; when the law fails they are zero,
/// history.failed is 1, and what was stored counts as dissipated. Faces that press on each other bear no normal traction here: that
/// is for contact. Conserves energy (work = stored + dissipated) to the second order of the step; pressure does work from outside.
Traction update_traction(const TractionLawSpec& law, const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history);

/// Largest ratio of traction to opening, Pa/m: limits the time step.
double largest_stiffness(const TractionLawSpec& law);

/// G_Ic and G_IIc, J/m2; infinite for laws that never fail, zero without a law.
PerMode toughness(const TractionLawSpec& law);

}  // namespace crampon
