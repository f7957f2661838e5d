#include "crampon/geometry/placed.hpp"

#include <algorithm>
#include <utility>

#include "crampon/geometry/angle.hpp"

namespace crampon {
namespace {
// Product in which an exact zero wins over an infinite bound.
double scaled(double factor, double length) { return factor == 0 ? 0 : factor * length; }
}  // namespace

Rotated::Rotated(RegionPtr shape, double angle, const Vec<3>& about, const Vec<3>& axis)
    : shape_(std::move(shape)), about_(about), in_plane_(axis[0] == 0 && axis[1] == 0) {
  const Vec<3> a = normalized(axis);
  const auto [c, s] = direction_of(angle).c;
  // Rodrigues' formula: R = c I + s [a]x + (1-c) a a^T; the diagonal as a_k^2 + c (1 - a_k^2), exact for coordinate axes.
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const int third = 3 - i - j;
      const double sign = (j - i + 3) % 3 == 1 ? -1 : 1;
      columns_[j][i] = i == j ? a[i] * a[i] + c * (1 - a[i] * a[i]) : (1 - c) * a[i] * a[j] + sign * s * a[third];
    }
  }
}

Vec<3> Rotated::turn_back(const Vec<3>& x) const {
  const Vec<3> r = x - about_;
  return about_ + Vec<3>{{dot(columns_[0], r), dot(columns_[1], r), dot(columns_[2], r)}};
}

Vec<3> Rotated::outward(const Vec<3>& x) const {
  const Vec<3> n = shape_->outward(turn_back(x));
  return n[0] * columns_[0] + n[1] * columns_[1] + n[2] * columns_[2];
}

Bounds3 Rotated::bounds() const {
  const Bounds3 inner = shape_->bounds();
  Bounds3 box{about_, about_};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double one = scaled(columns_[j][i], inner.low[j] - about_[j]), other = scaled(columns_[j][i], inner.high[j] - about_[j]);
      box.low[i] += std::min(one, other);
      box.high[i] += std::max(one, other);
    }
  }
  return box;
}

std::optional<double> Rotated::measure() const {
  // The area of a plane shape loses its meaning when the shape is tilted out of its plane.
  return in_plane_ || shape_->dimension() == 3 ? shape_->measure() : std::nullopt;
}

int Rotated::dimension() const { return in_plane_ ? shape_->dimension() : 3; }

Translated::Translated(RegionPtr shape, const Vec<3>& by) : shape_(std::move(shape)), by_(by) {}

Bounds3 Translated::bounds() const {
  const Bounds3 inner = shape_->bounds();
  return {inner.low + by_, inner.high + by_};
}

Vec<3> Mirrored::outward(const Vec<3>& x) const {
  Vec<3> out = shape_->outward(image(x));
  out[axis_] = -out[axis_];
  return out;
}

Bounds3 Mirrored::bounds() const {
  Bounds3 box = shape_->bounds();
  const double low = 2 * at_ - box.high[axis_];
  box.high[axis_] = 2 * at_ - box.low[axis_];
  box.low[axis_] = low;
  return box;
}

}  // namespace crampon
