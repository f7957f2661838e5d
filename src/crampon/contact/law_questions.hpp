#pragma once
/// What a contact law is asked, and the words in which it answers (docs/theory/contact.md, which law).

#include <compare>
#include <optional>

namespace crampon {

/// What happens between two faces before any law of sliding is asked.
enum class Meeting {
  never,     ///< they pass through each other: they are no pair
  pressing,  ///< they push each other apart where they would overlap, and the law says how they slide
  springs,   ///< springs hold them together and apart; once these have failed, they meet as faces that press
  joined     ///< they are one body
};

/// What the particles beside a contact remember of it for the law; each keeps one number.
enum class Remembered {
  nothing,
  slip,    ///< the distance slipped so far, m; never falls
  failure  ///< 1 once the springs have failed
};

/// Two faces that press on each other and would slide, at one node in one task.
struct Sliding {
  double normal = 0;  ///< N A dt: size of the normal impulse, kg m/s
  double full = 0;    ///< d_t: size of the impulse that would stop all slip, kg m/s
  double mass = 0;    ///< reduced mass, kg: slip at the end is (full - impulse)/mass
  double dt = 0;      ///< s
  double area = 0;    ///< A, m2, for laws that need it
  double slip = 0;    ///< distance slipped so far, m, for laws that remember it
};

/// The tangential impulse of a contact that slides: per_normal * N A dt + rest, S_slide A dt in kg m/s. Both are at least zero.
struct SlidingLimit {
  bool sticks = false;
  double per_normal = 0, rest = 0;

  static constexpr SlidingLimit stick() { return {true, 0, 0}; }
  /// Sticks when the impulse that would stop all slip is within what the law bears.
  static SlidingLimit up_to(const Sliding& s, double per_normal, double rest = 0) {
    return per_normal * s.normal + rest >= s.full ? stick() : SlidingLimit{false, per_normal, rest};
  }
};

/// Two faces that have met and are pulled apart, at one node in one task.
struct Pull {
  double normal = 0;  ///< impulse that would keep them from parting, kg m/s; below zero they press on each other
  double full = 0;    ///< size of the impulse that would stop all slip, kg m/s
  double dt = 0;      ///< s
  double area = 0;    ///< m2, above zero
};

/// Springs across an interface, and the tractions at which they fail.
struct ContactSprings {
  double tangential = 0;                  ///< D_t, Pa/m; infinite: no slip
  double tension = 0;                     ///< D_nt, Pa/m; infinite: does not open
  double compression = 0;                 ///< D_nc, Pa/m; infinite: does not close
  std::optional<double> shear_strength;   ///< Pa; none: never fails by shear
  std::optional<double> normal_strength;  ///< Pa; none: never fails by tension
  bool can_fail() const { return shear_strength || normal_strength; }
};

/// How little freedom a law leaves to faces between which several laws lie (contact/strictest.hpp); compared from the first member to the last.
struct Strictness {
  /// What the law can hold at all, from the least to the most.
  enum class Holds { nothing, overlap, film, friction, adhesion, springs, slip, everything };
  Holds holds = Holds::nothing;
  double first = 0;   ///< friction: the coefficient at rest; a film: its drag, Pa s/m; springs: their stiffness along the face, Pa/m
  double second = 0;  ///< friction: the shear stress that it bears without pressure, Pa; springs: their stiffness across the face, Pa/m
  auto operator<=>(const Strictness&) const = default;
};

}  // namespace crampon
