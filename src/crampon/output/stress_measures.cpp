#include "crampon/output/stress_measures.hpp"

#include <array>
#include <cmath>

namespace crampon {

namespace {

double mean(const double* s) { return (s[0] + s[1] + s[2]) / 3; }

double pressure(const double* s, double) { return -mean(s); }

double von_mises(const double* s, double) {
  const double m = mean(s);
  double square = 0;
  for (int k = 0; k < 3; ++k) square += (s[k] - m) * (s[k] - m) + 2 * s[3 + k] * s[3 + k];
  return std::sqrt(1.5 * square);
}

double fringes(const double* s, double k_f) { return std::cos(k_f * 1e-6 * std::hypot(s[0] - s[1], 2 * s[3])); }

constexpr std::array measures{
    StressMeasure{"pressure", "Pa", "mean pressure, compression positive", "p = -(sigma_xx + sigma_yy + sigma_zz) / 3", pressure},
    StressMeasure{"von_mises", "Pa", "equivalent stress", "sqrt(3/2 s:s), s = sigma + p I", von_mises},
    StressMeasure{"fringes", "", "photoelastic, N03 Eq. 23", "cos(k_f sqrt((sigma_xx - sigma_yy)^2 + 4 sigma_xy^2))", fringes}};

}  // namespace

std::span<const StressMeasure> stress_measures() { return measures; }

const StressMeasure* find_stress_measure(std::string_view name) {
  for (const StressMeasure& m : measures) {
    if (m.name == name) return &m;
  }
  return nullptr;
}

}  // namespace crampon
