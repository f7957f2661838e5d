#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// Friction that falls from static_friction to friction, and cohesion that vanishes, with the distance slipped.
struct SlipWeakeningContact {
  enum class Decay { exponential, linear };
  double friction = 0, static_friction = 0;  ///< dimensionless
  double distance = 0;                       ///< d_c, m
  double shear_strength = 0;                 ///< S_a at no slip, Pa
  Decay decay = Decay::exponential;

  static constexpr const char* name = "slip_weakening";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = false;
  static std::vector<SlipWeakeningContact> examples() {
    return {{0.2, 0.6, 0.01, 1e5, Decay::exponential}, {0.2, 0.6, 0.01, 1e5, Decay::linear}};
  }
  bool needs_area() const { return true; }
  Remembered remembers() const { return Remembered::slip; }
  Strictness strictness() const { return {Strictness::Holds::friction, static_friction, shear_strength}; }

  SlidingLimit limit(const Sliding& s) const {
    const double share = s.slip / distance, left = std::max(1 - share, 0.);
    const double fall = decay == Decay::linear ? left : std::exp(-share);
    return SlidingLimit::up_to(s, friction + (static_friction - friction) * fall, shear_strength * left * s.area * s.dt);
  }

  static const Declaration<SlipWeakeningContact>& declaration() {
    static const auto d =
        Declaration<SlipWeakeningContact>(name, "Friction that falls, and cohesion that vanishes, with the distance slipped.")
            .quantity("friction", &SlipWeakeningContact::friction, "1", Bounds::non_negative(), "coefficient after long slip",
                      Presence::required)
            .quantity("static_friction", &SlipWeakeningContact::static_friction, "1", Bounds::non_negative(), "coefficient before slip",
                      Presence::required)
            .quantity("distance", &SlipWeakeningContact::distance, "m", Bounds::positive(), "distance of slip over which they change",
                      Presence::required)
            .quantity("shear_strength", &SlipWeakeningContact::shear_strength, "Pa", Bounds::non_negative(),
                      "cohesion: shear stress borne without pressure before slip")
            .choice("decay", &SlipWeakeningContact::decay, {{"exponential", Decay::exponential}, {"linear", Decay::linear}},
                    "how the coefficient falls; cohesion always falls linearly");
    return d;
  }
};

}  // namespace crampon
