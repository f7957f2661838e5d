#include "crampon/geometry/rough_measure.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {

namespace {

double measure_in(const Region& shape, int dimension, const Vec<3>& low, const Vec<3>& high, int halvings) {
  Vec<3> middle;
  double measure = 1, reach = 0;
  std::size_t longest = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
    const double edge = high[k] - low[k];
    middle[k] = 0.5 * (low[k] + high[k]);
    measure *= edge;
    reach += 0.25 * edge * edge;
    if (edge > high[longest] - low[longest]) longest = k;
  }
  reach = std::sqrt(reach);
  // A ball about the middle settles a box whose corners are nearer than the boundary.
  const double distance = shape.distance(middle);
  if (!(distance <= reach)) return 0;
  if (distance <= -reach) return measure;
  if (halvings == 0) return distance < 0 ? measure : 0;
  Vec<3> lower_end = high, upper_start = low;
  lower_end[longest] = upper_start[longest] = middle[longest];
  return measure_in(shape, dimension, low, lower_end, halvings - 1) + measure_in(shape, dimension, upper_start, high, halvings - 1);
}

}  // namespace

double rough_measure(const Region& shape, int dimension, const Bounds3& box) {
  const Bounds3 bounds = shape.bounds();
  Vec<3> low, high;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
    low[k] = std::max(box.low[k], bounds.low[k]);
    high[k] = std::min(box.high[k], bounds.high[k]);
    if (!(low[k] < high[k])) return 0;
  }
  return measure_in(shape, dimension, low, high, 12);
}

}  // namespace crampon
