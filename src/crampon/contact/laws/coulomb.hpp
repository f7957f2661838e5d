#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// Coulomb friction: tangential impulse at most friction times the normal impulse.
struct CoulombContact {
  double friction = 0;                         ///< coefficient mu of sliding, dimensionless
  std::optional<double> static_friction = {};  ///< ... at the onset of sliding; none: the same
  std::optional<double> strength = {};         ///< most shear stress that friction reaches, Pa; none: no limit

  static constexpr const char* name = "coulomb";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = false;
  static std::vector<CoulombContact> examples() { return {{0.3, {}, {}}, {0.3, 0.5, {}}, {0.3, 0.5, 2e6}}; }
  bool needs_area() const { return strength.has_value(); }
  Remembered remembers() const { return Remembered::nothing; }
  /// Friction that never exceeds a stress is less strict than without that limit.
  Strictness strictness() const {
    return {Strictness::Holds::friction, std::max(friction, static_friction.value_or(0)), strength ? -1 / *strength : 0};
  }

  SlidingLimit limit(const Sliding& s) const {
    const double most = strength ? *strength * s.area * s.dt : HUGE_VAL;
    const double at_onset = std::max(static_friction.value_or(0), friction);
    if (std::min(at_onset * s.normal, most) >= s.full) return SlidingLimit::stick();
    return friction * s.normal <= most ? SlidingLimit{false, friction, 0} : SlidingLimit{false, 0, most};
  }

  static const Declaration<CoulombContact>& declaration() {
    static const auto d = Declaration<CoulombContact>(name, "Stick up to the friction limit, then slip against a constant ratio.")
                              .quantity("friction", &CoulombContact::friction, "1", Bounds::non_negative(),
                                        "coefficient of friction: tangential over normal impulse while sliding", Presence::required)
                              .quantity("static_friction", &CoulombContact::static_friction, "1", Bounds::non_negative(),
                                        "coefficient at the onset of sliding; left out: the same as friction")
                              .quantity("strength", &CoulombContact::strength, "Pa", Bounds::positive(),
                                        "shear stress that friction never exceeds; left out: no limit")
                              .check([](const CoulombContact& in, Diagnostics& diagnostics) {
                                if (in.static_friction && *in.static_friction < in.friction)
                                  diagnostics.add("static_friction", "static_friction is below friction",
                                                  fmt::format("{} < {}", *in.static_friction, in.friction),
                                                  "more is needed to start sliding than to keep it up");
                              });
    return d;
  }
};

}  // namespace crampon
