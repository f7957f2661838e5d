#include "crampon/geometry/arc.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "crampon/geometry/angle.hpp"

namespace crampon {
namespace {
// Number of equal parts of at most `longest` in `whole`; round-off in a whole number of parts does not add one.
int count_parts(double whole, double longest) {
  const double parts = std::ceil(whole / longest * (1 - 1e-9));
  if (!(parts < std::numeric_limits<int>::max())) throw std::invalid_argument("the longest segment is too short for this length");
  return std::max(1, static_cast<int>(parts));
}
}  // namespace

std::vector<Vec<2>> divide_arc(const Vec<2>& centre, double radius, double from, double to, int segments) {
  if (segments < 1) throw std::invalid_argument("an arc has at least one segment");
  if (!(radius > 0)) throw std::invalid_argument("the radius of an arc is positive");
  std::vector<Vec<2>> points;
  points.reserve(segments + 1);
  for (int k = 0; k <= segments; ++k) {
    const double angle = k == segments ? to : from + (to - from) * (static_cast<double>(k) / segments);
    points.push_back(centre + radius * direction_of(angle));
  }
  if (std::abs(std::abs(to - from) - 2 * std::numbers::pi) < 1e-12) points.back() = points.front();
  return points;
}

int count_arc_segments(double radius, double from, double to, double max_segment) {
  if (!(max_segment > 0)) throw std::invalid_argument("the longest segment is positive");
  // A chord over the angle a is 2 r sin(a/2) long; a chord of the diameter or more never limits.
  const double half_angle = std::asin(std::min(1., max_segment / (2 * radius)));
  return count_parts(std::abs(to - from), 2 * half_angle);
}

template <int Dim>
std::vector<Vec<Dim>> divide_polyline(const std::vector<Vec<Dim>>& points, double max_segment) {
  if (!(max_segment > 0)) throw std::invalid_argument("the longest segment is positive");
  std::vector<Vec<Dim>> divided;
  for (std::size_t k = 0; k < points.size(); ++k) {
    divided.push_back(points[k]);
    if (k + 1 == points.size()) break;
    const Vec<Dim> step = points[k + 1] - points[k];
    const int parts = count_parts(norm(step), max_segment);
    for (int i = 1; i < parts; ++i) divided.push_back(points[k] + step * (static_cast<double>(i) / parts));
  }
  return divided;
}

template std::vector<Vec<2>> divide_polyline(const std::vector<Vec<2>>&, double);
template std::vector<Vec<3>> divide_polyline(const std::vector<Vec<3>>&, double);

}  // namespace crampon
