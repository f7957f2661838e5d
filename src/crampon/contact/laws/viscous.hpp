#pragma once
#include <vector>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// A film of liquid: shear stress viscosity * v / film.
struct ViscousContact {
  double viscosity = 0;  ///< eta, Pa s
  double film = 0;       ///< thickness h_l, m

  static constexpr const char* name = "viscous";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = false;
  static std::vector<ViscousContact> examples() { return {{1e-3, 1e-6}}; }
  bool needs_area() const { return true; }
  Remembered remembers() const { return Remembered::nothing; }
  Strictness strictness() const { return {Strictness::Holds::film, viscosity / film}; }

  /// S = eta A v/h_l with v = (d_t - S)/m.
  SlidingLimit limit(const Sliding& s) const {
    const double drag = viscosity * s.area * s.dt / (s.mass * film);
    return {false, 0, s.full * drag / (1 + drag)};
  }

  static const Declaration<ViscousContact>& declaration() {
    static const auto d =
        Declaration<ViscousContact>(name, "A film of liquid between the two: shear stress is viscosity times speed over its thickness.")
            .quantity("viscosity", &ViscousContact::viscosity, "Pa s", Bounds::positive(), "viscosity of the film", Presence::required)
            .quantity("film", &ViscousContact::film, "m", Bounds::positive(), "thickness of the film", Presence::required);
    return d;
  }
};

}  // namespace crampon
