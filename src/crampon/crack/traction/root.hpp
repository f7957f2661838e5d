#pragma once
/// One equation in one unknown.

#include <cmath>
#include <limits>

namespace crampon {

/// Root of a function that rises from at most 0 at low to at least 0 at high. value_and_slope(x) returns {f, df/dx}.
/// Newton's method from start, between the two; where it would leave the bracket or slows down, bisection.
template <class F>
double find_root(double low, double high, double start, F value_and_slope) {
  double x = start, step_before = high - low;
  for (int k = 0; k < 200; ++k) {
    const auto [f, slope] = value_and_slope(x);
    if (f == 0) return x;
    (f < 0 ? low : high) = x;
    double next = x - f / slope;
    if (!(next > low && next < high && std::abs(next - x) < 0.5 * step_before)) next = low + 0.5 * (high - low);
    step_before = std::abs(next - x);
    x = next;
    if (step_before <= 2 * std::numeric_limits<double>::epsilon() * std::abs(x)) break;
  }
  return x;
}

}  // namespace crampon
