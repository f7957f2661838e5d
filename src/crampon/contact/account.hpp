#pragma once
/// The energy that contact takes from the particles in a step (docs/theory/contact.md, energy).

#include "crampon/core/vector.hpp"

namespace crampon {

/// Tasks of the step; or a term of a series for velocities after Task 4 (step/velocity_series.hpp), which only keeps the state of Task 4.
enum class ContactTask { two, four, six, term };

/// Of what moves as one at a node. Rigid bodies keep such an account too: what they give is work at the boundary.
template <int Dim>
struct ContactAccount {
  Vec<Dim> v_start;    ///< before Task 2, m/s
  Vec<Dim> v_settled;  ///< after it
  Vec<Dim> gain;       ///< what the forces of Task 3 added to it, m/s
  Vec<Dim> dp2, dp4;   ///< impulses of Tasks 2 and 4, kg m/s

  /// With v- and v+ the velocities before Task 2 and before Task 6, and da what the forces of Task 3 add, contact takes
  /// -1/2 (J4.v- - da.J2) - 1/2 (J4.v+ - da.J6), half in Task 4, half in Task 6, J. before, after: velocities about this task, m/s; dp: its
  /// impulse, kg m/s.
  double book(ContactTask task, const Vec<Dim>& before, const Vec<Dim>& dp, const Vec<Dim>& after, bool re_extrapolates) {
    switch (task) {
      case ContactTask::two:
        v_start = before;
        v_settled = after;
        dp2 = dp;
        return 0;
      case ContactTask::four: {
        dp4 = dp;
        gain = before - v_settled;
        const double first = -0.5 * (dot(dp4, v_start) - dot(gain, dp2));
        return re_extrapolates ? first : first - 0.5 * dot(dp4, after);  // without Task 6 the step ends with Task 4
      }
      case ContactTask::six:
        return -0.5 * (dot(dp4, before) - dot(gain, dp));
      case ContactTask::term:
        return 0;
    }
    return 0;
  }
};

}  // namespace crampon
