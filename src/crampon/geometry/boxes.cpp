#include "crampon/geometry/boxes.hpp"

#include <algorithm>
#include <limits>

#include "crampon/geometry/direction.hpp"

namespace crampon {
namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();

// How far x is beyond the nearest pair of faces, axis by axis; both differences vanish exactly on a face.
template <int Dim>
double box_distance(const Vec<Dim>& low, const Vec<Dim>& high, const Vec<3>& x) {
  double outside2 = 0, largest = -infinity;
  for (int k = 0; k < Dim; ++k) {
    const double beyond = std::max(low[k] - x[k], x[k] - high[k]);
    largest = std::max(largest, beyond);
    if (beyond > 0) outside2 += beyond * beyond;
  }
  return outside2 > 0 ? std::sqrt(outside2) : largest;
}

template <int Dim>
Vec<3> box_outward(const Vec<Dim>& low, const Vec<Dim>& high, const Vec<3>& x) {
  Vec<3> from_box, nearest_face;
  double largest = -infinity;
  for (int k = 0; k < Dim; ++k) {
    const double below = low[k] - x[k], above = x[k] - high[k];
    const double beyond = std::max(below, above), side = above >= below ? 1 : -1;
    if (beyond > 0) from_box[k] = side * beyond;
    if (beyond > largest) {
      largest = beyond;
      nearest_face = {};
      nearest_face[k] = side;
    }
  }
  return largest > 0 ? unit_along(from_box) : nearest_face;
}
}  // namespace

double Rectangle::distance(const Vec<3>& x) const { return box_distance<2>(low, high, x); }
Vec<3> Rectangle::outward(const Vec<3>& x) const { return box_outward<2>(low, high, x); }
Bounds3 Rectangle::bounds() const { return {{{low[0], low[1], -infinity}}, {{high[0], high[1], infinity}}}; }
std::optional<double> Rectangle::measure() const { return (high[0] - low[0]) * (high[1] - low[1]); }

double Box::distance(const Vec<3>& x) const { return box_distance<3>(low, high, x); }
Vec<3> Box::outward(const Vec<3>& x) const { return box_outward<3>(low, high, x); }
std::optional<double> Box::measure() const { return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]); }

}  // namespace crampon
