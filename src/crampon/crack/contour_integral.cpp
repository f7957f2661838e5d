#include "crampon/crack/contour_integral.hpp"

#include <vector>

namespace crampon {

namespace {

/// The part of a length about `middle` that lies inside the circle, both as distances from the tip, m.
double inside(double radius, double middle, double length) { return std::clamp((radius - middle) / length + 0.5, 0., 1.); }

/// Of one particle: the tensor (W + K) delta_kJ - P_iJ u_i,k as [k][J], J/m3.
Tensor2 energy_momentum(const TipSample& s) {
  const double energy = s.energy + 0.5 * s.density * dot(s.velocity, s.velocity);
  Tensor2 out{};
  for (std::size_t k = 0; k < 2; ++k) {
    out[k] = -(s.stress[0] * s.gradient[0][k] + s.stress[1] * s.gradient[1][k]);
    out[k][k] += energy;
  }
  return out;
}

/// A tensor as it is at a place, from samples about it.
class FitAbout {
 public:
  /// reach: m; samples further away do not count.
  explicit FitAbout(double reach) : reach_(reach) {}
  /// way: from the place, m.
  void add(const Vec<2>& way, double area, const Tensor2& value) {
    const Vec<2> y = way * (1 / reach_);
    const double square = dot(y, y);
    if (square >= 1) return;
    const double w = area * (1 - square) * (1 - square);
    sum_ += w;
    mean_ += y * w;
    for (std::size_t i = 0; i < 2; ++i) {
      spread_[i] += y * (w * y[i]);
      for (std::size_t k = 0; k < 2; ++k) value_[i][k] += w * value[i][k], moment_[i][k] += y * (w * value[i][k]);
    }
  }
  /// Of the linear field that fits best; nothing without samples.
  Tensor2 value() const {
    if (!(sum_ > 0)) return {};
    const Vec<2> mean = mean_ * (1 / sum_);
    // A direction in which places hardly differ (their spread is 1/8 where they fill the circle evenly) counts as if the field did not change along it.
    constexpr double least_spread = 1e-4;
    const double xx = spread_[0][0] / sum_ - mean[0] * mean[0] + least_spread, xy = spread_[0][1] / sum_ - mean[0] * mean[1],
                 yy = spread_[1][1] / sum_ - mean[1] * mean[1] + least_spread, det = xx * yy - xy * xy;
    Tensor2 out{};
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        const double of = value_[i][k] / sum_;
        const Vec<2> with = moment_[i][k] * (1 / sum_) - mean * of;
        const Vec<2> slope{{(yy * with[0] - xy * with[1]) / det, (xx * with[1] - xy * with[0]) / det}};
        out[i][k] = of - dot(slope, mean);
      }
    }
    return out;
  }

 private:
  double reach_, sum_ = 0;
  Vec<2> mean_;
  Tensor2 spread_{}, value_{};
  std::array<std::array<Vec<2>, 2>, 2> moment_{};
};

}  // namespace

Vec<2> contour_integral(std::span<const TipSample> samples, const TipPath& path, double radius, double cell,
                        std::span<const FaceTraction> tractions, std::span<const CrackSideSample> faces) {
  constexpr double turn = 2 * std::numbers::pi;
  const double reach = 1.5 * cell;
  struct Near {
    Vec<2> place;
    double direction, area;
    Tensor2 flux;
  };
  std::vector<Near> near;
  Vec<2> J;
  for (const TipSample& s : samples) {
    const double r = norm(s.place);
    if (std::fabs(r - radius) < reach) near.push_back({s.place, path.direction(s.place), s.area, energy_momentum(s)});
    const double mass = s.density * s.area * inside(radius, r, std::sqrt(s.area));
    for (std::size_t i = 0; i < 2; ++i) J += (s.gradient[i] * s.inertia[i] - s.rate[i] * s.velocity[i]) * mass;
  }
  const double face = path.angle(radius);  // of the upper one; the lower one lies a turn before it
  const int pieces = static_cast<int>(std::ceil(4 * turn * radius / cell));
  for (int k = 0; k <= pieces; ++k) {
    const double theta = face - turn * k / pieces, weight = k == 0 || k == pieces ? 0.5 : 1;
    const Vec<2> n{{std::cos(theta), std::sin(theta)}};
    FitAbout fit(reach);
    for (const Near& p : near) {
      if (std::fabs(p.direction - theta) < turn / 2) fit.add(p.place - n * radius, p.area, p.flux);
    }
    const Tensor2 flux = fit.value();
    J += Vec<2>{{dot(flux[0], n), dot(flux[1], n)}} * (weight * turn * radius / pieces);
  }
  for (const FaceTraction& f : tractions)
    J[0] += inside(radius, 0.5 * (f.near + f.far), std::fabs(f.far - f.near)) * dot(f.traction, f.opening_step);
  for (const CrackSideSample& f : faces) J += f.normal * (inside(radius, norm(f.place), f.length) * f.energy * f.length);
  return J;
}

}  // namespace crampon
