#include "crampon/crack/traction/pressure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crampon {

Traction PressureTraction::respond(const PerMode& u, double time, const Vec<3>& x, TractionHistory& history) const {
  history.largest_normal_opening = std::max(history.largest_normal_opening, u.normal);
  history.largest_shear_opening = std::max(history.largest_shear_opening, std::abs(u.shear));
  if (min_opening && !(u.normal > *min_opening)) return {};
  return {-pressure(time, x), 0, 0};
}

PerMode PressureTraction::toughness() const { return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}; }

std::vector<PressureTraction> PressureTraction::examples() {
  return {{ValueFunction::constant(1e5), {}}, {ValueFunction::constant(1e5), 1e-6}};
}

const Declaration<PressureTraction>& PressureTraction::declaration() {
  using Law = PressureTraction;
  static const auto d = Declaration<Law>(name, "A pressure in the crack that pushes its faces apart.")
                            .function("pressure", &Law::pressure, "Pa", "pressure, of time and place", Presence::required)
                            .quantity("min_opening", &Law::min_opening, "m", Bounds::any(),
                                      "the pressure acts only where the crack is open further than this; left out: everywhere");
  return d;
}

}  // namespace crampon
