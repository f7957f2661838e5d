#pragma once
/// Which of two laws rules where both lie between the same two faces.

#include "crampon/contact/law.hpp"

namespace crampon {

/// The law that leaves less freedom: first by what it can hold at all (none, frictionless, a viscous film, friction, adhesion, springs of
/// an interface, stick, bonded), then by friction at rest, then by the shear stress that it bears without pressure (a viscous film: by
/// its drag, an interface: by its stiffness). The first of equals.
inline const ContactLaw& strictest(const ContactLaw& a, const ContactLaw& b) { return b.strictness() > a.strictness() ? b : a; }

}  // namespace crampon
