#pragma once
/// Numbers made of a stress: each formula stands here alone.

#include <span>
#include <string_view>

namespace crampon {

struct StressMeasure {
  std::string_view name;
  std::string_view unit;  ///< empty: a bare number
  std::string_view help, formula;
  /// stress: xx, yy, zz, xy, yz, xz, Pa; fringe_constant: 1/MPa, for fringes alone.
  double (*of)(const double* stress, double fringe_constant);
};

/// pressure, von_mises and fringes.
std::span<const StressMeasure> stress_measures();
/// Null where there is no measure of that name.
const StressMeasure* find_stress_measure(std::string_view name);

}  // namespace crampon
