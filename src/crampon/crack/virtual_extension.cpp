#include "crampon/crack/virtual_extension.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {

namespace {

constexpr double nearest_corner = 2.5, radius_of_corner = 1.5;  // cells
constexpr double sharp = 20 * std::numbers::pi / 180;           // from this turn on a bend is a corner
constexpr int per_cell = 8;                                     // directions that are kept

Vec<2> on(const TipPath& path, double r) {
  const double angle = path.angle(r);
  return Vec<2>{{std::cos(angle), std::sin(angle)}} * r;
}
/// Direction of the path towards the tip, over a cell to either side.
Vec<2> chord(const TipPath& path, double r, double cell) {
  return normalized(on(path, std::fmax(r - cell, 0)) - on(path, std::fmax(r + cell, 2 * cell)));
}
/// By how much the path turns at a distance from the tip, over a cell to either side, rad.
double turn(const TipPath& path, double r, double cell) {
  const Vec<2> here = on(path, r), before = here - on(path, r + cell), after = on(path, r - cell) - here;
  return std::fabs(std::atan2(cross(before, after), dot(before, after)));
}

}  // namespace

VirtualExtension::VirtualExtension(const TipWeight& weight, const TipPath& path, double cell)
    : weight_(weight), spacing_(cell / per_cell), around_corner_(radius_of_corner * cell) {
  const auto count = static_cast<std::size_t>(std::ceil(weight.outer() / spacing_)) + 2;
  for (std::size_t k = 0; k < count; ++k) {
    const double r = static_cast<double>(k) * spacing_;
    path_.push_back(on(path, r)), along_.push_back(chord(path, r, cell));
  }
  double sharpest = 0;  // of the bend that is being passed
  for (double r = nearest_corner * cell; r < weight.outer() + around_corner_; r += spacing_) {
    const double here = turn(path, r, cell);
    if (here < sharp) {
      sharpest = 0;
    } else if (sharpest == 0) {
      sharpest = here, corners_.push_back(on(path, r));
    } else if (here > sharpest) {
      sharpest = here, corners_.back() = on(path, r);
    }
  }
}

bool VirtualExtension::meets_corners() const {
  return std::any_of(corners_.begin(), corners_.end(), [&](const Vec<2>& corner) { return norm(corner) < weight_.outer(); });
}

VirtualExtension::Part VirtualExtension::beside_corners(const Vec<2>& place) const {
  Part part;
  for (const Vec<2>& corner : corners_) {
    const Vec<2> from = place - corner;
    const double r = norm(from), s = r / around_corner_;
    if (s >= 1) continue;
    const double value = s * s * (3 - 2 * s);
    const Vec<2> slope = r > 0 ? from * (6 * s * (1 - s) / (around_corner_ * r)) : Vec<2>{};
    part.slope = part.slope * value + slope * part.value;
    part.value *= value;
  }
  return part;
}

VirtualExtension::Direction VirtualExtension::direction(double r) const {
  if (along_.empty()) return {};
  const double at = r / spacing_;
  const auto k = std::min(static_cast<std::size_t>(at), along_.size() - 2);
  const Vec<2> step = along_[k + 1] - along_[k];
  return {along_[k] + step * (at - static_cast<double>(k)), step * (1 / spacing_)};
}

VirtualExtension::Shift VirtualExtension::at(const Vec<2>& place) const {
  const double r = norm(place), w = weight_.at(r);
  const Vec<2> outwards = r > 0 ? place * (1 / r) : Vec<2>{};
  const Direction along = direction(r);
  const Part part = beside_corners(place);
  Shift shift;
  shift.q = along.value * (w * part.value);
  for (std::size_t k = 0; k < 2; ++k)
    shift.gradient[k] =
        outwards * ((weight_.slope(r) * along.value[k] + w * along.slope[k]) * part.value) + part.slope * (w * along.value[k]);
  return shift;
}

double VirtualExtension::on_path(double r) const {
  const double w = weight_.at(r);
  if (corners_.empty() || w == 0) return w;
  const double at = r / spacing_;
  const auto k = std::min(static_cast<std::size_t>(at), path_.size() - 2);
  return w * beside_corners(path_[k] + (path_[k + 1] - path_[k]) * (at - static_cast<double>(k))).value;
}

}  // namespace crampon
