#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// An imperfect interface: tractions in proportion to the displacement across it (docs/theory/contact.md, interfaces; contact/interface.hpp).
struct InterfaceContact {
  double tangential = 0;                       ///< D_t, Pa/m; infinite: no slip
  double tension = 0;                          ///< D_nt, Pa/m; infinite: does not open
  double compression = HUGE_VAL;               ///< D_nc, Pa/m; infinite: does not close
  std::optional<double> shear_strength = {};   ///< Pa; reached: the interface is gone and contact is left
  std::optional<double> normal_strength = {};  ///< Pa
  double friction = 0;                         ///< of that contact

  static constexpr const char* name = "interface";
  static constexpr Meeting meeting = Meeting::springs;
  static constexpr bool adheres = false;
  static std::vector<InterfaceContact> examples() { return {{1e9, 1e9, HUGE_VAL, {}, {}, 0}, {1e9, 2e9, 3e9, 1e6, 2e6, 0.3}}; }
  bool needs_area() const { return true; }
  Remembered remembers() const { return springs().can_fail() ? Remembered::failure : Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::springs, tangential, std::max(tension, compression)}; }
  ContactSprings springs() const { return {tangential, tension, compression, shear_strength, normal_strength}; }

  /// Once the interface has failed.
  SlidingLimit limit(const Sliding& s) const { return SlidingLimit::up_to(s, friction); }

  static const Declaration<InterfaceContact>& declaration() {
    static const Bounds stiffness{.low = 0, .infinite = true};
    static const auto d =
        Declaration<InterfaceContact>(name,
                                      "An imperfect interface: tractions in proportion to the displacement across it since the start.")
            .quantity("tangential", &InterfaceContact::tangential, "Pa/m", stiffness, "stiffness against sliding; inf: none",
                      Presence::required)
            .quantity("tension", &InterfaceContact::tension, "Pa/m", stiffness, "stiffness against opening; inf: none", Presence::required)
            .quantity("compression", &InterfaceContact::compression, "Pa/m", stiffness, "stiffness against closing; inf: none")
            .quantity("shear_strength", &InterfaceContact::shear_strength, "Pa", Bounds::positive(),
                      "shear traction at which it fails for good, with (S/shear_strength)^2 + (N/normal_strength)^2 = 1; left out: never "
                      "by shear")
            .quantity("normal_strength", &InterfaceContact::normal_strength, "Pa", Bounds::positive(),
                      "tensile traction at which it fails; left out: never by tension")
            .quantity("friction", &InterfaceContact::friction, "1", Bounds::non_negative(), "coefficient of friction once it has failed");
    return d;
  }
};

}  // namespace crampon
