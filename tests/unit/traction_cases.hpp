#pragma once
/// Traction laws for tests, and their curves written once more as plain functions (docs/theory/traction.md).

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "crampon/crack/traction/coupled_sawtooth.hpp"
#include "crampon/crack/traction/cubic.hpp"
#include "crampon/crack/traction/decoupled.hpp"
#include "crampon/crack/traction/elastic_brittle.hpp"
#include "crampon/crack/traction/exponential.hpp"
#include "crampon/crack/traction/law.hpp"
#include "crampon/crack/traction/linear_elastic.hpp"
#include "crampon/crack/traction/mixed_mode.hpp"
#include "crampon/crack/traction/none.hpp"
#include "crampon/crack/traction/pressure.hpp"
#include "crampon/crack/traction/triangular.hpp"
#include "crampon/crack/traction/trilinear.hpp"
#include "crampon/crack/traction/user_curve.hpp"

namespace crampon::test {

using TriangularTraction = DecoupledTraction<TriangularInput>;
using TrilinearTraction = DecoupledTraction<TrilinearInput>;
using CubicTraction = DecoupledTraction<CubicInput>;
using ExponentialTraction = DecoupledTraction<ExponentialInput>;
using UserCurveTraction = DecoupledTraction<UserCurveInput>;
using BrittleTraction = DecoupledTraction<BrittleInput>;

/// A curve of one mode in the plainest words.
struct PlainCurve {
  std::function<double(double)> S;  ///< Pa, from 0 to end
  std::vector<double> kinks;        ///< m, from 0 to end: S is smooth between them
  double k = 0, elastic = 0;        ///< S = k u up to `elastic`

  double end() const { return kinks.back(); }
  double work(double u) const {
    double sum = 0;
    for (std::size_t j = 1; j < kinks.size(); ++j) {
      const double a = std::min(kinks[j - 1], u), h = (std::min(kinks[j], u) - a) / 1000;
      for (int i = 0; i < 1000; ++i)  // Simpson; just inside the ends, where S may jump
        sum += h / 6 * (S(a + (i + 1e-14) * h) + 4 * S(a + (i + 0.5) * h) + S(a + (i + 1 - 1e-14) * h));
    }
    return sum;
  }
  double secant(double largest) const { return largest >= end() ? 0 : largest <= elastic ? k : S(largest) / largest; }
  double dissipated(double largest) const {
    return largest >= end() ? work(end()) : largest <= elastic ? 0 : work(largest) - 0.5 * S(largest) * largest;
  }
  /// The opening at damage D, by bisection.
  double opening_at(double D) const {
    double low = elastic, high = end();
    for (int i = 0; i < 60; ++i) {
      const double u = 0.5 * (low + high);
      (S(u) > (1 - D) * k * u ? low : high) = u;
    }
    return 0.5 * (low + high);
  }
};

inline constexpr double sigma = 5e6, u_c = 1e-4, u_p = 1e-5;
inline const std::vector<double> table_u = {1e-5, 2.5e-5, 4e-5, 7e-5, 1e-4}, table_S = {5e6, 4.6e6, 2e6, 1.9e6, 0.1e6};

/// Monotone cubics through the table: Hermite basis functions, harmonic means of the slopes.
inline double table_curve(double u) {
  const std::size_t n = table_u.size();
  std::vector<double> h(n - 1), d(n - 1), m(n, 0.);
  for (std::size_t j = 0; j + 1 < n; ++j) h[j] = table_u[j + 1] - table_u[j], d[j] = (table_S[j + 1] - table_S[j]) / h[j];
  for (std::size_t j = 1; j + 1 < n; ++j) {
    const double w = (h[j - 1] + 2 * h[j]) / (3 * (h[j - 1] + h[j]));
    m[j] = d[j - 1] * d[j] / (w * d[j] + (1 - w) * d[j - 1]);
  }
  m[0] = std::clamp(d[0] + (d[0] - d[1]) * h[0] / (h[0] + h[1]), 3 * d[0], 0.);
  m[n - 1] = std::clamp(d[n - 2] + (d[n - 2] - d[n - 3]) * h[n - 2] / (h[n - 2] + h[n - 3]), 3 * d[n - 2], 0.);
  for (std::size_t j = 0; j + 1 < n; ++j) {
    if (u > table_u[j + 1]) continue;
    const double t = (u - table_u[j]) / h[j], s = 1 - t;
    return table_S[j] * s * s * (1 + 2 * t) + table_S[j + 1] * t * t * (3 - 2 * t) + h[j] * t * s * (m[j] * s - m[j + 1] * t);
  }
  return table_S.back();
}

inline PlainCurve plain(const std::string& kind) {
  const auto elastic_then = [](std::function<double(double)> rest) {
    return [rest](double u) { return u < u_p ? sigma * u / u_p : rest(u); };
  };
  const double k = sigma / u_p;
  if (kind == "triangular") return {elastic_then([](double u) { return sigma * (u_c - u) / (u_c - u_p); }), {0, u_p, u_c}, k, u_p};
  if (kind == "trilinear")
    return {elastic_then([](double u) { return u < 4e-5 ? 5e6 - 3.5e6 * (u - 1e-5) / 3e-5 : 1.5e6 * (u_c - u) / 6e-5; }),
            {0, u_p, 4e-5, u_c},
            k,
            u_p};
  if (kind == "cubic")
    return {[](double u) { return 27. / 4 * sigma * u / u_c * std::pow(1 - u / u_c, 2); }, {0, u_c}, 6.75 * sigma / u_c, 0};
  if (kind == "exponential")
    return {elastic_then([](double u) { return sigma * (std::exp(-4 * (u - u_p) / (u_c - u_p)) - std::exp(-4)) / (1 - std::exp(-4)); }),
            {0, u_p, u_c},
            k,
            u_p};
  if (kind == "user_curve") return {elastic_then(table_curve), {0, 1e-5, 2.5e-5, 4e-5, 7e-5, 1e-4}, k, u_p};
  return {[](double u) { return sigma * u / u_c; }, {0, u_c}, sigma / u_c, u_c};  // elastic_brittle
}

/// In shear the same shapes with other sizes.
inline constexpr double more_stress = 1.7, more_opening = 1.3;
inline PlainCurve plain_shear(const std::string& kind) {
  const PlainCurve c = plain(kind);
  PlainCurve out{[c](double u) { return more_stress * c.S(u / more_opening); }, c.kinks, c.k * more_stress / more_opening,
                 c.elastic * more_opening};
  for (double& x : out.kinks) x *= more_opening;
  return out;
}

inline TriangularCurve triangular(double a = 1, double b = 1) { return {a * sigma, b * u_p, b * u_c}; }
inline TrilinearCurve trilinear(double a = 1, double b = 1) { return {a * sigma, b * u_p, a * 1.5e6, b * 4e-5, b * u_c}; }
inline CubicCurve cubic(double a = 1, double b = 1) { return {a * sigma, b * u_c}; }
inline ExponentialCurve exponential(double a = 1, double b = 1) { return {a * sigma, b * u_p, b * u_c, 4}; }
inline BrittleCurve brittle(double a = 1, double b = 1) { return {a * sigma, b * u_c}; }
inline UserCurve user_curve(double a = 1, double b = 1) {
  auto u = table_u, S = table_S;
  for (double& x : u) x *= b;
  for (double& x : S) x *= a;
  return {u, S};
}

struct Case {
  std::string name, curve, shear_curve;
  TractionLawSpec law;
};
inline std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }
inline std::vector<Case> all_cases(double mode_exponent = 1) {
  constexpr double a = more_stress, b = more_opening;
  return {{"triangular", "triangular", "triangular", TriangularTraction{triangular(), triangular(a, b), mode_exponent}},
          {"trilinear", "trilinear", "trilinear", TrilinearTraction{trilinear(), trilinear(a, b), mode_exponent}},
          {"cubic", "cubic", "cubic", CubicTraction{cubic(), cubic(a, b), mode_exponent}},
          {"exponential", "exponential", "exponential", ExponentialTraction{exponential(), exponential(a, b), mode_exponent}},
          {"user_curve", "user_curve", "user_curve", UserCurveTraction{user_curve(), user_curve(a, b), mode_exponent}},
          {"elastic_brittle", "elastic_brittle", "elastic_brittle", BrittleTraction{brittle(), brittle(a, b), mode_exponent}},
          {"coupled_sawtooth", "triangular", "triangular", CoupledSawtooth{triangular(), triangular(a, b)}},
          {"mixed_triangular", "triangular", "triangular", MixedModeTraction{triangular(), triangular(a, b)}},
          {"mixed_trilinear", "trilinear", "trilinear", MixedModeTraction{trilinear(), trilinear(a, b)}},
          {"mixed_cubic", "cubic", "cubic", MixedModeTraction{cubic(), cubic(a, b)}},
          {"mixed_exponential", "exponential", "exponential", MixedModeTraction{exponential(), exponential(a, b)}},
          {"mixed_cubic_exponential", "cubic", "exponential", MixedModeTraction{cubic(), exponential(a, b)}},
          {"mixed_trilinear_triangular", "trilinear", "triangular", MixedModeTraction{trilinear(), triangular(a, b)}}};
}

}  // namespace crampon::test
