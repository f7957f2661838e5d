#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// mu = friction + (static_friction - friction)/(1 + v/half_speed): from rest smoothly down to sliding.
struct RateWeakeningContact {
  double friction = 0, static_friction = 0;  ///< dimensionless
  double half_speed = 0;                     ///< v_h, m/s
  double shear_strength = 0;                 ///< S_a, Pa

  static constexpr const char* name = "rate_weakening";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = false;
  static std::vector<RateWeakeningContact> examples() { return {{0.2, 0.6, 0.1, 1e5}}; }
  bool needs_area() const { return true; }
  Remembered remembers() const { return Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::friction, static_friction, shear_strength}; }

  /// (S - a)(D - S) = (mu_s - mu_d) N m v_h with a = S_a + mu_d N and D = d_t + m v_h: the smaller root, written so that nothing cancels
  /// where v_h is far above the speeds at hand.
  SlidingLimit limit(const Sliding& s) const {
    const double cohesion = shear_strength * s.area * s.dt;
    if (static_friction * s.normal + cohesion >= s.full) return SlidingLimit::stick();
    const double a = cohesion + friction * s.normal, D = s.full + s.mass * half_speed;
    const double fall = (static_friction - friction) * s.normal * s.mass * half_speed;
    const double root = std::sqrt(std::max((D - a) * (D - a) - 4 * fall, 0.));
    return {false, 0, std::min(a + 2 * fall / (D - a + root), s.full)};
  }

  static const Declaration<RateWeakeningContact>& declaration() {
    static const auto d = Declaration<RateWeakeningContact>(name, "Friction that falls smoothly from rest to sliding.")
                              .quantity("friction", &RateWeakeningContact::friction, "1", Bounds::non_negative(),
                                        "coefficient at high speed", Presence::required)
                              .quantity("static_friction", &RateWeakeningContact::static_friction, "1", Bounds::non_negative(),
                                        "coefficient at rest", Presence::required)
                              .quantity("half_speed", &RateWeakeningContact::half_speed, "m/s", Bounds::positive(),
                                        "speed at which half of the fall is done", Presence::required)
                              .quantity("shear_strength", &RateWeakeningContact::shear_strength, "Pa", Bounds::non_negative(),
                                        "shear stress that is borne without pressure")
                              .check([](const RateWeakeningContact& in, Diagnostics& diagnostics) {
                                if (in.static_friction < in.friction)
                                  diagnostics.add("static_friction", "static_friction is below friction",
                                                  fmt::format("{} < {}", in.static_friction, in.friction),
                                                  "use speed_friction for friction that rises with speed");
                              });
    return d;
  }
};

}  // namespace crampon
