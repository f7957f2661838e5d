#pragma once
#include "crampon/core/members.hpp"

namespace crampon {

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

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [normal_opening, shear_opening, normal_traction, shear_traction, largest_normal_opening, largest_shear_opening, damage,
           dissipated_normal, dissipated_shear, work_normal, work_shear, failed] = self;
    visit(Member{"normal_opening", "m"}, normal_opening);
    visit(Member{"shear_opening", "m"}, shear_opening);
    visit(Member{"normal_traction", "Pa"}, normal_traction);
    visit(Member{"shear_traction", "Pa"}, shear_traction);
    visit(Member{"largest_normal_opening", "m"}, largest_normal_opening);
    visit(Member{"largest_shear_opening", "m"}, largest_shear_opening);
    visit(Member{"damage"}, damage);
    visit(Member{"dissipated_normal", "J/m2"}, dissipated_normal);
    visit(Member{"dissipated_shear", "J/m2"}, dissipated_shear);
    visit(Member{"work_normal", "J/m2"}, work_normal);
    visit(Member{"work_shear", "J/m2"}, work_shear);
    visit(Member{"failed"}, failed);
  }
};

}  // namespace crampon
