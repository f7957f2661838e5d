#pragma once
#include <algorithm>
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// Faces that have met hold together until (S/shear_strength)^2 + (N/normal_strength)^2 = 1; friction and the shear strength resist
/// sliding under pressure.
struct AdhesiveContact {
  double friction = 0;         ///< dimensionless
  double shear_strength = 0;   ///< S_a, Pa
  double normal_strength = 0;  ///< N_a, Pa

  static constexpr const char* name = "adhesive";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = true;
  static std::vector<AdhesiveContact> examples() { return {{0.3, 1e5, 2e5}}; }
  bool needs_area() const { return true; }
  Remembered remembers() const { return Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::adhesion, friction, shear_strength}; }

  SlidingLimit limit(const Sliding& s) const { return SlidingLimit::up_to(s, friction, shear_strength * s.area * s.dt); }
  bool holds(const Pull& pull) const {
    const double N = std::max(pull.normal, 0.) / (pull.area * pull.dt * normal_strength),
                 S = pull.full / (pull.area * pull.dt * shear_strength);
    return N * N + S * S < 1;
  }

  static const Declaration<AdhesiveContact>& declaration() {
    static const auto d = Declaration<AdhesiveContact>(
                              name,
                              "What has met holds together until (S/shear_strength)^2 + (N/normal_strength)^2 reaches 1; under pressure "
                              "the shear strength adds to friction.")
                              .quantity("friction", &AdhesiveContact::friction, "1", Bounds::non_negative(), "coefficient of friction")
                              .quantity("shear_strength", &AdhesiveContact::shear_strength, "Pa", Bounds::positive(),
                                        "shear stress that adhesion bears", Presence::required)
                              .quantity("normal_strength", &AdhesiveContact::normal_strength, "Pa", Bounds::positive(),
                                        "tensile stress that adhesion bears", Presence::required);
    return d;
  }
};

}  // namespace crampon
