#pragma once
/// What a traction law is asked and what it answers (docs/theory/traction.md).

#include "crampon/state/traction_history.hpp"

namespace crampon {

/// One value for opening across the crack and one for sliding along it. As an opening, m: upper minus lower surface point along the
/// normal from below to above, and along the tangent. Sliding has a sign in 2D; in 3D it is the length of the tangential vector.
struct PerMode {
  double normal = 0, shear = 0;
};

/// normal resists opening, shear resists sliding and has its sign, Pa; stored: recoverable energy, J/m2.
struct Traction {
  double normal = 0, shear = 0, stored = 0;
};

}  // namespace crampon
