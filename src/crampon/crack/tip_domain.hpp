#pragma once
/// The surroundings of a crack tip over which fracture parameters are integrals (docs/theory/fracture.md, the domain). All places are those of the
/// undeformed body, relative to the tip and in its frame: the first axis goes on from the crack, the second is a quarter turn to the left of it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "crampon/core/vector.hpp"

namespace crampon {

/// A tensor of the plane: [i][k], of component i along axis k.
using Tensor2 = std::array<Vec<2>, 2>;

/// Axes of a tip in those of the grid.
struct TipFrame {
  Vec<2> tip;  ///< m
  Vec<2> ahead, left;

  TipFrame(const Vec<2>& at, const Vec<2>& behind) : tip(at), ahead(normalized(at - behind)), left{{-ahead[1], ahead[0]}} {}
  Vec<2> turned(const Vec<2>& a) const { return {{dot(a, ahead), dot(a, left)}}; }
  /// Turned to the left by the angle of a direction {cos, sin}.
  TipFrame turned_by(const Vec<2>& direction) const {
    TipFrame out = *this;
    out.ahead = ahead * direction[0] + left * direction[1];
    out.left = left * direction[0] - ahead * direction[1];
    return out;
  }
};
/// Components of a tensor whose indices belong to two frames.
inline Tensor2 turned(const Tensor2& a, const TipFrame& first, const TipFrame& second) {
  const Vec<2> rows[2] = {second.turned(a[0]), second.turned(a[1])};
  return {rows[0] * first.ahead[0] + rows[1] * first.ahead[1], rows[0] * first.left[0] + rows[1] * first.left[1]};
}

/// What the integrals take of a particle.
struct TipSample {
  Vec<2> place;        ///< m
  double area = 0;     ///< initial volume per thickness, m2
  double density = 0;  ///< initial, kg/m3
  Tensor2 stress{};    ///< first Piola-Kirchhoff stress P[i][K], Pa
  Tensor2 gradient{};  ///< u_i,K
  double energy = 0;   ///< all work of the stress, per initial volume, J/m3
  Vec<2> velocity;     ///< m/s
  Vec<2> inertia;      ///< acceleration less what body forces and damping make of it, m/s2
  Tensor2 rate{};      ///< of the gradient, 1/s
};

/// The weight q of the domain: 1 up to the inner radius, 0 from the outer one on, and a smooth step between, which sums over particles
/// integrate more exactly than a ramp.
class TipWeight {
 public:
  TipWeight(double inner, double outer) : inner_(inner), outer_(outer) {}
  double at(double r) const {
    const double s = part(r);
    return 1 - s * s * (3 - 2 * s);
  }
  /// dq/dr, 1/m.
  double slope(double r) const {
    const double s = part(r);
    return -6 * s * (1 - s) / (outer_ - inner_);
  }
  double outer() const { return outer_; }  ///< m

 private:
  double part(double r) const { return std::clamp((r - inner_) / (outer_ - inner_), 0., 1.); }
  double inner_, outer_;  ///< m
};

/// The path of a crack as its tip sees it.
class TipPath {
 public:
  /// points: from the tip backwards, the first at the origin.
  explicit TipPath(const std::vector<Vec<2>>& points) {
    for (const Vec<2>& x : points) {
      // Where it comes back, what lies further in has met it already.
      if (bends_.empty() || norm(x) > norm(bends_.back())) bends_.push_back(x);
    }
  }
  /// The direction in which the crack lies at a distance from the tip, rad, near pi.
  double angle(double r) const {
    double angle = std::numbers::pi;
    for (std::size_t k = 1; k < bends_.size(); ++k) {
      const bool here = norm(bends_[k]) >= r;
      const Vec<2> x = here ? on_circle(bends_[k - 1], bends_[k], r) : bends_[k];
      const double next = std::atan2(x[1], x[0]);
      angle = next + 2 * std::numbers::pi * std::round((angle - next) / (2 * std::numbers::pi));
      if (here) break;
    }
    return angle;
  }
  /// The direction of a place, rad: from the lower side of the crack, a full turn less, up to the upper side.
  double direction(const Vec<2>& place) const {
    const double crack = angle(norm(place));
    double theta = std::atan2(place[1], place[0]);
    while (theta > crack) theta -= 2 * std::numbers::pi;
    while (theta <= crack - 2 * std::numbers::pi) theta += 2 * std::numbers::pi;
    return theta;
  }

 private:
  /// Where the way from a, inside the circle, to b, outside of it, crosses it.
  static Vec<2> on_circle(const Vec<2>& a, const Vec<2>& b, double r) {
    const Vec<2> way = b - a;
    const double square = dot(way, way), half = dot(a, way), rest = r * r - dot(a, a);
    return a + way * ((std::sqrt(std::fmax(half * half + square * rest, 0)) - half) / square);
  }
  std::vector<Vec<2>> bends_;  ///< ever further from the tip
};

}  // namespace crampon
