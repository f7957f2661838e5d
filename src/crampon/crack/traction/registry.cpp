#include "crampon/crack/traction/coupled_sawtooth.hpp"
#include "crampon/crack/traction/cubic.hpp"
#include "crampon/crack/traction/decoupled.hpp"
#include "crampon/crack/traction/elastic_brittle.hpp"
#include "crampon/crack/traction/exponential.hpp"
#include "crampon/crack/traction/law.hpp"
#include "crampon/crack/traction/linear_elastic.hpp"
#include "crampon/crack/traction/mixed_mode.hpp"
#include "crampon/crack/traction/none.hpp"
#include "crampon/crack/traction/pressure.hpp"
#include "crampon/crack/traction/triangular.hpp"
#include "crampon/crack/traction/trilinear.hpp"
#include "crampon/crack/traction/user_curve.hpp"

namespace crampon {

std::vector<TractionLawSpec> traction_law_examples() {
  traction_laws();  // laws join as the family is made
  return examples_of_family<TractionLawSpec>();
}

TractionLawSpec::TractionLawSpec() {
  static const auto none = std::make_shared<const TractionLawOf<NoTraction>>(NoTraction{});
  law_ = none;
}

// A further law is one file like linear_elastic.hpp and one line here; a further curve for each mode, a file like cubic.hpp and a line with
// DecoupledTraction.
Family<TractionLawSpec>& traction_laws() {
  static Family<TractionLawSpec> family = [] {
    Family<TractionLawSpec> f("traction law", "law", "What holds the faces of a crack together, or pushes them apart.");
    add_traction_law<NoTraction>(f);
    add_traction_law<DecoupledTraction<TriangularInput>>(f);
    add_traction_law<DecoupledTraction<TrilinearInput>>(f);
    add_traction_law<DecoupledTraction<CubicInput>>(f);
    add_traction_law<DecoupledTraction<ExponentialInput>>(f);
    add_traction_law<DecoupledTraction<UserCurveInput>>(f);
    add_traction_law<DecoupledTraction<BrittleInput>>(f);
    add_traction_law<CoupledSawtooth>(f);
    add_traction_law<MixedModeTraction>(f);
    add_traction_law<LinearElasticTraction>(f);
    add_traction_law<PressureTraction>(f);
    return f;
  }();
  return family;
}

}  // namespace crampon
