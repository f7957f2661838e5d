#pragma once
/// How much a contact law resists sliding (docs/theory/contact.md, which law).

#include "crampon/contact/law.hpp"

namespace crampon {

/// Two fields that press on each other and would slide, at one node in one task.
struct Sliding {
  double normal = 0;  ///< N A dt: size of the normal impulse, kg m/s
  double full = 0;    ///< d_t: size of the impulse that would stop all slip, kg m/s
  double mass = 0;    ///< reduced mass, kg: slip at the end is (full - impulse)/mass
  double dt = 0;      ///< s
  double area = 0;    ///< A, m2
  double slip = 0;    ///< distance slipped so far, m
};

/// The tangential impulse of a contact that slides: per_normal * N A dt + rest, S_slide A dt in kg m/s.
struct SlidingLimit {
  bool sticks = false;
  double per_normal = 0, rest = 0;
};

/// Whether the law stops all slip, and with what impulse it resists if not.
SlidingLimit sliding_limit(const ContactLawSpec& law, const Sliding& sliding);

/// Does the law need the contact area, or what the particles beside the contact remember of it?
bool needs_area(const ContactLawSpec& law);
bool needs_history(const ContactLawSpec& law);

/// Adhesion: do faces that have met stay together under a pulling impulse and a tangential one, kg m/s? False for other laws.
bool adhesion_holds(const ContactLawSpec& law, double pull, double full, double area, double dt);

}  // namespace crampon
