#include "crampon/crack/traction/linear_elastic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crampon {

Traction LinearElasticTraction::respond(const PerMode& u, double, const Vec<3>&, TractionHistory& history) const {
  history.largest_normal_opening = std::max(history.largest_normal_opening, u.normal);
  history.largest_shear_opening = std::max(history.largest_shear_opening, std::abs(u.shear));
  const Traction T{normal_stiffness * u.normal, shear_stiffness * u.shear, 0};
  return {T.normal, T.shear, 0.5 * (T.normal * u.normal + T.shear * u.shear)};
}

PerMode LinearElasticTraction::toughness() const {
  return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

std::vector<LinearElasticTraction> LinearElasticTraction::examples() { return {{1e11, 2e11}}; }

const Declaration<LinearElasticTraction>& LinearElasticTraction::declaration() {
  using Law = LinearElasticTraction;
  static const auto d =
      Declaration<Law>(name, "Springs between the faces that never fail.")
          .quantity("normal_stiffness", &Law::normal_stiffness, "Pa/m", Bounds::non_negative(), "traction per opening", Presence::required)
          .quantity("shear_stiffness", &Law::shear_stiffness, "Pa/m", Bounds::non_negative(), "traction per sliding", Presence::required);
  return d;
}

}  // namespace crampon
