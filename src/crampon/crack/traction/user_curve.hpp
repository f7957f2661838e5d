#pragma once
#include <vector>

#include "crampon/core/declaration.hpp"

namespace crampon {

/// A table whose first point is the peak: elastic up to it, then through the points without overshoot (PCHIP: F. N. Fritsch,
/// J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300). Where the last stress is not 0, the rest is lost at once.
class UserCurve {
 public:
  UserCurve() = default;
  /// openings (m) rise from above 0, stresses (Pa) do not rise and the first is above 0; two points at least.
  UserCurve(std::vector<double> openings, std::vector<double> stresses);

  double stiffness() const { return S_.front() / u_.front(); }
  double onset() const { return u_.front(); }
  double final_opening() const { return u_.back(); }
  double toughness() const { return W_.back(); }
  double stress(double u) const;
  double dissipated(double u) const;

 private:
  std::vector<double> u_, S_;
  std::vector<double> m_;  ///< slopes at the points, Pa/m
  std::vector<double> W_;  ///< work up to the points, J/m2
  std::size_t piece(double u) const;
};

struct UserCurveInput {
  std::vector<double> openings, stresses;
  static constexpr const char* name = "user_curve";
  static UserCurveInput example();  ///< of a real crack, for tests
  static const Declaration<UserCurveInput>& declaration();
  UserCurve curve() const { return {openings, stresses}; }
};

}  // namespace crampon
