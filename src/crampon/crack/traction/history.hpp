#pragma once
/// What a traction law is asked, what it answers and what a crack vertex remembers of it (docs/theory/traction.md).

#include <array>

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

/// History of one vertex; all zero at the start. A struct for each law would be smaller; one for all keeps arrays, checkpoints and
/// results free of laws.
struct TractionHistory {
  double normal_opening = 0;          ///< at the last update, m; faces that press count as 0 (but not under pressure)
  double shear_opening = 0;           ///< at the last update, m
  double normal_traction = 0;         ///< at the last update, Pa
  double shear_traction = 0;          ///< at the last update, Pa
  double largest_normal_opening = 0;  ///< m; mixed_mode: the normal opening that would do the same damage alone
  double largest_shear_opening = 0;   ///< m; mixed_mode: likewise
  double damage = 0;                  ///< 0 to 1; mixed_mode: D; coupled_sawtooth: lambda_m; the others: the larger D of the modes
  double dissipated_normal = 0;       ///< G_I, J/m2
  double dissipated_shear = 0;        ///< G_II, J/m2
  double work_normal = 0;             ///< of the traction on the opening, trapezoids over the steps, J/m2
  double work_shear = 0;              ///< likewise on sliding, J/m2
  double failed = 0;                  ///< 1 once the law is used up: no traction any more
};

/// A member as checkpoints and results name it.
struct TractionHistoryField {
  const char* name;
  const char* unit;  ///< SI
  double TractionHistory::*member;
};

inline constexpr std::array<TractionHistoryField, 12> traction_history_fields = {{
    {"normal_opening", "m", &TractionHistory::normal_opening},
    {"shear_opening", "m", &TractionHistory::shear_opening},
    {"normal_traction", "Pa", &TractionHistory::normal_traction},
    {"shear_traction", "Pa", &TractionHistory::shear_traction},
    {"largest_normal_opening", "m", &TractionHistory::largest_normal_opening},
    {"largest_shear_opening", "m", &TractionHistory::largest_shear_opening},
    {"damage", "1", &TractionHistory::damage},
    {"dissipated_normal", "J/m2", &TractionHistory::dissipated_normal},
    {"dissipated_shear", "J/m2", &TractionHistory::dissipated_shear},
    {"work_normal", "J/m2", &TractionHistory::work_normal},
    {"work_shear", "J/m2", &TractionHistory::work_shear},
    {"failed", "1", &TractionHistory::failed},
}};

}  // namespace crampon
