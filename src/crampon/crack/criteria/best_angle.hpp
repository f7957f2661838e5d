#pragma once
#include <cmath>
#include <numbers>

namespace crampon {

/// The angle in [low, high], rad, at which f is largest: the best of even steps of half a degree, then a search between its neighbours.
template <class F>
double best_angle(double low, double high, F f) {
  constexpr double step = std::numbers::pi / 360;
  double best = low, value = f(low);
  for (int k = 1; low + k * step <= high; ++k) {
    const double there = f(low + k * step);
    if (there > value) best = low + k * step, value = there;
  }
  double a = std::fmax(low, best - step), b = std::fmin(high, best + step);
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    (f(c) > f(d) ? b : a) = f(c) > f(d) ? d : c;
  }
  return 0.5 * (a + b);
}

/// The angle of the largest hoop stress about a tip, rad: K_I sin(theta) + K_II (3 cos(theta) - 1) = 0 (Erdogan and Sih, J. Basic Eng. 85 (1963)).
inline double hoop_angle(double K_I, double K_II) {
  if (K_II == 0) return 0;
  const double root = std::sqrt(K_I * K_I + 8 * K_II * K_II);
  // tan(theta/2) = (K_I - root)/(4 K_II), without cancellation.
  return K_I > 0 ? 2 * std::atan(-2 * K_II / (K_I + root)) : 2 * std::atan((K_I - root) / (4 * K_II));
}

}  // namespace crampon
