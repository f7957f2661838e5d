#pragma once
/// Opening and sliding each with a curve of their own; only failure is common (docs/theory/traction.md; J. A. Nairn, Int. J. Fract. 155
/// (2009) 167; failure: Q. D. Yang, M. D. Thouless, Int. J. Fract. 110 (2001) 175).

#include <algorithm>
#include <cmath>
#include <vector>

#include "crampon/core/declaration.hpp"
#include "crampon/crack/traction/curve.hpp"
#include "crampon/crack/traction/path.hpp"

namespace crampon {

/// One mode: the largest opening so far, the stiffness of unloading from it and where the energy is.
struct ModeState {
  double largest = 0;     ///< m
  double secant = 0;      ///< Pa/m
  double dissipated = 0;  ///< J/m2
  double stored = 0;      ///< J/m2
  bool broken = false;
  double released() const { return dissipated + stored; }  ///< by failure now, all told: G, J/m2
};

template <class Curve>
ModeState mode_state(const Curve& curve, double largest_before, double opening) {
  const double u_c = curve.final_opening(), u = std::min(std::abs(opening), u_c);
  ModeState s;
  s.largest = std::max(largest_before, u);
  s.broken = s.largest >= u_c;
  s.secant = secant(curve, s.largest);
  s.dissipated = curve.dissipated(s.largest);
  s.stored = 0.5 * s.secant * u * u;
  return s;
}

/// The input of such a law: a sub-table for each mode.
template <class CurveInput>
struct DecoupledInput {
  CurveInput normal, shear;
  double mode_exponent = 1;
};

template <class CurveInput>
Declaration<DecoupledInput<CurveInput>> decoupled_declaration() {
  using Input = DecoupledInput<CurveInput>;
  const Record& curve = CurveInput::declaration();
  return Declaration<Input>(curve.name(), curve.help() + " Opening and sliding do not feel each other before failure.")
      .record("normal", &Input::normal, CurveInput::declaration, "curve of the opening", Presence::required)
      .record("shear", &Input::shear, CurveInput::declaration, "curve of the sliding", Presence::required)
      .quantity("mode_exponent", &Input::mode_exponent, "1", Bounds::any(),
                "m in the failure rule (G_I/G_Ic)^m + (G_II/G_IIc)^m = 1; 0 or less: infinite, each mode fails by itself");
}

template <class CurveInput>
struct DecoupledTraction {
  using Input = DecoupledInput<CurveInput>;
  using Curve = decltype(CurveInput().curve());
  Curve normal, shear;
  double mode_exponent = 1;  ///< m; 0 or less: infinite, modes fail each by itself

  static constexpr const char* name = CurveInput::name;
  static constexpr bool acts = true;
  static constexpr bool acts_closed = false;
  static constexpr bool from_outside = false;
  static DecoupledTraction make(const Input& in) { return {in.normal.curve(), in.shear.curve(), in.mode_exponent}; }
  static std::vector<DecoupledTraction> examples() {
    const Curve curve = CurveInput::example().curve();
    return {{curve, curve, 1}, {curve, curve, 0}};
  }
  static const Declaration<Input>& declaration() {
    static const auto d = decoupled_declaration<CurveInput>();
    return d;
  }

  Traction respond(const PerMode& opening, double, const Vec<3>&, TractionHistory& history) const {
    const PerMode before = {history.normal_opening, history.shear_opening};
    Both now = at(opening, history);
    if (fails(now)) {
      // Where on the way of this step? There the energy is taken.
      double low = 0, high = 1;
      for (int k = 0; k < 60; ++k) {
        const double s = 0.5 * (low + high);
        const Both there = at(opening_along(before, opening, s), history);
        if (fails(there))
          high = s, now = there;
        else
          low = s;
      }
      history.failed = history.damage = 1;
    } else {
      history.damage = std::max({0., 1 - now.normal.secant / normal.stiffness(), 1 - now.shear.secant / shear.stiffness()});
    }
    history.largest_normal_opening = now.normal.largest;
    history.largest_shear_opening = now.shear.largest;
    history.dissipated_normal = history.failed != 0 ? now.normal.released() : now.normal.dissipated;
    history.dissipated_shear = history.failed != 0 ? now.shear.released() : now.shear.dissipated;
    if (history.failed != 0) return {};
    return {now.normal.secant * opening.normal, now.shear.secant * opening.shear, now.normal.stored + now.shear.stored};
  }

  double largest_stiffness() const { return std::max(normal.stiffness(), shear.stiffness()); }
  PerMode toughness() const { return {normal.toughness(), shear.toughness()}; }

 private:
  struct Both {
    ModeState normal, shear;
  };
  Both at(const PerMode& opening, const TractionHistory& history) const {
    return {mode_state(normal, history.largest_normal_opening, opening.normal),
            mode_state(shear, history.largest_shear_opening, opening.shear)};
  }
  /// One mode at its end, or (G_I/G_Ic)^m + (G_II/G_IIc)^m >= 1 with what failure now would release in all.
  bool fails(const Both& b) const {
    if (b.normal.broken || b.shear.broken) return true;
    const double g_n = b.normal.released(), g_t = b.shear.released();
    if (!(mode_exponent > 0 && g_n > 0 && g_t > 0)) return false;
    return std::pow(g_n / normal.toughness(), mode_exponent) + std::pow(g_t / shear.toughness(), mode_exponent) >= 1;
  }
};

}  // namespace crampon
