#pragma once
#include <algorithm>
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// mu = friction + per_speed * v.
struct SpeedFrictionContact {
  double friction = 0;        ///< dimensionless, at no speed
  double per_speed = 0;       ///< k, s/m; negative: weakening
  double shear_strength = 0;  ///< S_a, Pa

  static constexpr const char* name = "speed_friction";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = false;
  static std::vector<SpeedFrictionContact> examples() { return {{0.2, 0.1, 1e5}, {0.4, -0.02, 1e5}}; }
  bool needs_area() const { return true; }
  Remembered remembers() const { return Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::friction, friction, shear_strength}; }

  /// S = S_a + (mu + k v) N with v = (d_t - S)/m, solved for S.
  SlidingLimit limit(const Sliding& s) const {
    const double cohesion = shear_strength * s.area * s.dt;
    if (friction * s.normal + cohesion >= s.full) return SlidingLimit::stick();
    const double with_speed = 1 + per_speed * s.normal / s.mass;
    if (with_speed <= 0) return SlidingLimit::stick();  // weakens faster than the slip can grow within the step
    const double S = (cohesion + (friction + per_speed * s.full / s.mass) * s.normal) / with_speed;
    return {false, 0, std::clamp(S, 0., s.full)};
  }

  static const Declaration<SpeedFrictionContact>& declaration() {
    static const auto d =
        Declaration<SpeedFrictionContact>(name, "Friction that changes in proportion to the speed of sliding: friction + per_speed v.")
            .quantity("friction", &SpeedFrictionContact::friction, "1", Bounds::non_negative(), "coefficient of friction at no speed",
                      Presence::required)
            .quantity("per_speed", &SpeedFrictionContact::per_speed, "s/m", Bounds::any(), "what a speed of 1 m/s adds to it",
                      Presence::required)
            .quantity("shear_strength", &SpeedFrictionContact::shear_strength, "Pa", Bounds::non_negative(),
                      "shear stress that is borne without pressure");
    return d;
  }
};

}  // namespace crampon
