#pragma once
/// How far it is out of a shape in a direction.

#include <optional>

#include "crampon/geometry/region.hpp"

namespace crampon {

/// From x in a shape along the unit vector n to the surface, m, to within `slack`, m; none within `limit`, m. Surfaces of parts that touch each
/// other, with nothing but `slack` between, are none of the whole.
std::optional<double> way_out(const Region& shape, const Vec<3>& x, const Vec<3>& n, double limit, double slack);

}  // namespace crampon
