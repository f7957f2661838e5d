#include "crampon/geometry/way_out.hpp"

namespace crampon {

std::optional<double> way_out(const Region& shape, const Vec<3>& x, const Vec<3>& n, double limit, double slack) {
  constexpr int most_steps = 300;
  double way = 0;
  for (int steps = 0; steps < most_steps && way <= limit; ++steps) {
    const double clear = -shape.distance(x + n * way);
    if (clear > 1e-3 * slack) {
      way += clear;
    } else if (shape.distance(x + n * (way + slack)) < 0) {  // into the next part
      way += slack;
    } else {
      return way;
    }
  }
  return std::nullopt;
}

}  // namespace crampon
