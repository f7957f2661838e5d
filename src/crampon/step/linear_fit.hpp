#pragma once
/// How the displacement of a point follows from those of particles about it (docs/decisions/0010-surface-points.md).

#include <array>
#include <cmath>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/material/spectrum.hpp"

namespace crampon {

/// Orthogonal directions and how far places are spread along each of them (variance).
template <int Dim>
struct PrincipalSpreads {
  std::array<Vec<Dim>, Dim> direction;
  std::array<double, Dim> variance;
};

/// Of places with these variances and covariances.
inline PrincipalSpreads<2> principal_spreads(const std::array<Vec<2>, 2>& covariance) {
  const double xx = covariance[0][0], xy = covariance[0][1], yy = covariance[1][1];
  const double middle = 0.5 * (xx + yy), half = 0.5 * (xx - yy), root = std::sqrt(half * half + xy * xy);
  // Directions of most and least spread. Where both are equal, any will do.
  Vec<2> along{{1, 0}};
  if (root > 1e-12 * middle) along = half > 0 ? normalized(Vec<2>{{half + root, xy}}) : normalized(Vec<2>{{xy, root - half}});
  return {{along, Vec<2>{{-along[1], along[0]}}}, {middle + root, middle - root}};
}
inline PrincipalSpreads<3> principal_spreads(const std::array<Vec<3>, 3>& covariance) {
  const Pack parts[6] = {splat(covariance[0][0]), splat(covariance[1][1]), splat(covariance[2][2]),
                         splat(covariance[0][1]), splat(covariance[1][2]), splat(covariance[0][2])};
  const SpaceSpectrum spectrum(parts);
  PrincipalSpreads<3> out;
  for (std::size_t e = 0; e < 3; ++e) {
    for (std::size_t k = 0; k < 3; ++k) out.direction[e][k] = spectrum.axis[3 * k + e][0];
    out.variance[e] = spectrum.value[e][0];
  }
  return out;
}

/// Weights of particles in the displacement of a point: of the fit of a linear field to theirs, each with some weight of its own.
template <int Dim>
struct LinearFit {
  /// Particles must be spread by this in every direction (variance, cells^2) ...
  static constexpr double least_variance = 0.02;
  /// ... and the point lie no further from their middle than the square root of this, in standard deviations. On an edge it is 1.7 of them
  /// away, in a corner in the plane 2.4, in one in space 2.9.
  static constexpr double most_leverage = 4 * Dim;

  double leverage = 0, variance = 0;  ///< of the point, 1; smallest of the particles' places, cells^2

  /// y: places less the point, cells; weights: own weights in, weights of the fit out. Directions in which places hardly differ count as
  /// if the field did not change along them.
  LinearFit(const std::vector<Vec<Dim>>& y, std::vector<double>& weights) {
    double sum = 0;
    Vec<Dim> mean{};
    for (std::size_t i = 0; i < y.size(); ++i) {
      sum += weights[i];
      mean += y[i] * weights[i];
    }
    mean *= 1 / sum;
    std::array<Vec<Dim>, Dim> covariance{};
    for (std::size_t i = 0; i < y.size(); ++i) {
      const Vec<Dim> d = y[i] - mean;
      for (int j = 0; j < Dim; ++j) {
        for (int k = j; k < Dim; ++k) covariance[j][k] += weights[i] / sum * d[j] * d[k];
      }
    }
    const PrincipalSpreads<Dim> spreads = principal_spreads(covariance);
    variance = spreads.variance[0];
    Vec<Dim> slope{};
    for (std::size_t e = 0; e < Dim; ++e) {
      const Vec<Dim>& along = spreads.direction[e];
      const double spread = spreads.variance[e];
      variance = std::fmin(variance, spread);
      if (spread < least_variance) continue;
      slope -= along * (dot(mean, along) / spread);
      leverage += dot(mean, along) * dot(mean, along) / spread;
    }
    for (std::size_t i = 0; i < y.size(); ++i) weights[i] *= (1 + dot(y[i] - mean, slope)) / sum;
  }
  bool good() const { return variance >= least_variance && leverage <= most_leverage; }
};

}  // namespace crampon
