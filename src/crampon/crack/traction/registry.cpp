#include "crampon/crack/traction/law.hpp"

namespace crampon {

namespace {

/// Adds the law that has a curve of this kind in each mode.
template <class CurveInput>
void add_decoupled(Family<TractionLawSpec>& family) {
  static const auto declaration = decoupled_declaration<CurveInput>();
  family.add(declaration, [](const DecoupledInput<CurveInput>& in) -> TractionLawSpec {
    return DecoupledTraction<decltype(in.normal.curve())>{in.normal.curve(), in.shear.curve(), in.mode_exponent};
  });
}

}  // namespace

const Declaration<NoTraction>& NoTraction::declaration() {
  static const auto d = Declaration<NoTraction>("none", "No traction.");
  return d;
}

const Family<TractionLawSpec>& traction_laws() {
  static const auto family = [] {
    Family<TractionLawSpec> f("traction law", "law", "What holds the faces of a crack together, or pushes them apart.");
    f.add(NoTraction::declaration());
    add_decoupled<TriangularInput>(f);
    add_decoupled<TrilinearInput>(f);
    add_decoupled<CubicInput>(f);
    add_decoupled<ExponentialInput>(f);
    add_decoupled<UserCurveInput>(f);
    add_decoupled<BrittleInput>(f);
    f.add(CoupledSawtoothInput::declaration(), [](const CoupledSawtoothInput& in) -> TractionLawSpec {
      return CoupledSawtooth{in.normal.curve(), in.shear.curve()};
    });
    f.add(MixedModeTraction::declaration());
    f.add(LinearElasticTraction::declaration());
    f.add(PressureTraction::declaration());
    return f;
  }();
  return family;
}

}  // namespace crampon
