#include "crampon/output/rigid_shape.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace crampon {
namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Vec<3> times(const std::array<double, 9>& a, const Vec<3>& v) {
  Vec<3> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = a[3 * k] * v[0] + a[3 * k + 1] * v[1] + a[3 * k + 2] * v[2];
  return out;
}

bool is_finite(const Bounds3& box) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!std::isfinite(box.low[k]) || !std::isfinite(box.high[k])) return false;
  return true;
}

}  // namespace

RigidView::RigidView(const RigidShape& rigid, double magnification, double height) : rigid_(rigid), low_(height), high_(height) {
  const Matrix identity = Matrix::Identity(), turn = Eigen::Map<const Matrix>(rigid.place.turn.data());
  const Matrix map = identity + magnification * (turn - identity);
  const Matrix back = map.inverse();  // not finite where a magnified turn folds the body up: then nothing covers anything
  std::copy_n(map.data(), 9, map_.begin());
  std::copy_n(back.data(), 9, back_.begin());
  scale_ = std::cbrt(std::abs(map.determinant()));
  // A turn in the plane, magnified, scales lengths of the plane and not of z.
  if (turn(2, 2) == 1) scale_ = std::sqrt(std::abs(map.determinant()));
  for (std::size_t k = 0; k < 3; ++k) centre_[k] = rigid.place.start[k] + magnification * (rigid.place.centre[k] - rigid.place.start[k]);
  hollow_ = rigid.surface && !std::isfinite(rigid.shape->bounds().high[0]);
  const bool in_space = rigid.shape->dimension() == 3;
  if (!in_space) return;
  if (rigid.surface && is_finite(rigid.shape->bounds())) {
    low_ = INFINITY, high_ = -INFINITY;
    for (int corner = 0; corner < 8; ++corner) {
      Vec<3> arm;
      for (std::size_t k = 0; k < 3; ++k)
        arm[k] = ((corner >> k & 1) != 0 ? rigid.surface->high[k] : rigid.surface->low[k]) - rigid.place.start[k];
      const double z = centre_[2] + times(map_, arm)[2];
      low_ = std::min(low_, z), high_ = std::max(high_, z);
    }
  } else if (!rigid.surface) {
    // The distance from an endless surface that faces the eye hardly changes across the picture.
    const double here = rigid.shape->distance(at_start(centre_[0], centre_[1], height));
    double most = 0;
    for (const auto& [dx, dy] : {std::pair{1., 0.}, {0., 1.}})
      most = std::max(most, std::abs(rigid.shape->distance(at_start(centre_[0] + dx, centre_[1] + dy, height)) - here));
    shows_an_edge_ = most > 0.05;
  }
}

Vec<3> RigidView::at_start(double x, double y, double z) const {
  return times(back_, Vec<3>{{x, y, z}} - centre_) + Vec<3>{{rigid_.place.start[0], rigid_.place.start[1], rigid_.place.start[2]}};
}

RigidView::Cover RigidView::cover(double x, double y, double r) const {
  // Distances change by no more than the way: what is further from the surface than r is on one side with all of the disk.
  if (is_section()) {
    const double d = rigid_.shape->distance(at_start(x, y, low_)) * scale_;
    return d < -r ? Cover::all : d > r || (r == 0 && d > 0) || std::isnan(d) ? Cover::none : r == 0 ? Cover::all : Cover::some;
  }
  const double least_step = 2e-4 * (high_ - low_);
  Cover found = Cover::none;
  for (double z = high_; z >= low_;) {
    const double d = rigid_.shape->distance(at_start(x, y, z)) * scale_;
    if (d < -r || (r == 0 && d <= 0)) return Cover::all;
    if (std::isnan(d)) return Cover::none;
    if (d <= r) found = Cover::some;
    z -= std::max({least_step, d - r, d <= r ? r : 0.});
  }
  return r == 0 ? Cover::none : found;
}

double RigidView::top(double x, double y) const {
  if (is_section()) return -INFINITY;
  const double least_step = 2e-4 * (high_ - low_);
  double z = high_;
  for (; z > low_;) {
    const double d = rigid_.shape->distance(at_start(x, y, z)) * scale_;
    if (!(d > 0)) break;
    z -= std::max(least_step, d);
  }
  return z;
}

std::optional<std::array<double, 4>> RigidView::bounds() const {
  if (!rigid_.surface) return std::nullopt;
  const Bounds3& box = *rigid_.surface;
  std::array<double, 4> out{INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (int corner = 0; corner < 8; ++corner) {
    Vec<3> arm;
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = (corner >> k & 1) != 0 ? box.high[k] : box.low[k];
      arm[k] = std::isfinite(c) ? c - rigid_.place.start[k] : 0;
    }
    const Vec<3> x = centre_ + times(map_, arm);
    for (std::size_t k = 0; k < 2; ++k) {
      out[2 * k] = std::min(out[2 * k], x[k]);
      out[2 * k + 1] = std::max(out[2 * k + 1], x[k]);
    }
  }
  return out;
}

std::vector<bool> covered_pixels(const RigidView& view, const Raster& raster) {
  std::vector<bool> covered(raster.index(0, raster.height), false);
  const auto fill = [&](int left, int top, int side, auto&& self) -> void {
    if (left >= raster.width || top >= raster.height) return;
    const double middle = 0.5 * (side - 1), half_diagonal = side == 1 ? 0 : 0.7072 * side * raster.size;
    const double x = raster.x(left) + middle * raster.size, y = raster.y(top) - middle * raster.size;
    const RigidView::Cover cover = view.cover(x, y, half_diagonal);
    if (cover == RigidView::Cover::none) return;
    if (cover == RigidView::Cover::all) {
      for (int j = top; j < std::min(top + side, raster.height); ++j)
        for (int i = left; i < std::min(left + side, raster.width); ++i) covered[raster.index(i, j)] = true;
      return;
    }
    for (const int j : {top, top + side / 2})
      for (const int i : {left, left + side / 2}) self(i, j, side / 2, self);
  };
  constexpr int tile = 64;
  for (int top = 0; top < raster.height; top += tile)
    for (int left = 0; left < raster.width; left += tile) fill(left, top, tile, fill);
  return covered;
}

}  // namespace crampon
