#pragma once
/// Small fixed-size vectors of the model, for everything outside the particle loops (those use core/pack.hpp).

#include <array>
#include <cmath>
#include <cstddef>

namespace crampon {

/// Point or vector in Dim dimensions; coordinates in metres unless a member says otherwise.
template <int Dim>
struct Vec {
  std::array<double, Dim> c{};

  constexpr double& operator[](std::size_t k) { return c[k]; }
  constexpr double operator[](std::size_t k) const { return c[k]; }

  constexpr Vec& operator+=(const Vec& b) {
    for (int k = 0; k < Dim; ++k) c[k] += b.c[k];
    return *this;
  }
  constexpr Vec& operator-=(const Vec& b) {
    for (int k = 0; k < Dim; ++k) c[k] -= b.c[k];
    return *this;
  }
  constexpr Vec& operator*=(double s) {
    for (int k = 0; k < Dim; ++k) c[k] *= s;
    return *this;
  }
  friend constexpr Vec operator+(Vec a, const Vec& b) { return a += b; }
  friend constexpr Vec operator-(Vec a, const Vec& b) { return a -= b; }
  friend constexpr Vec operator*(Vec a, double s) { return a *= s; }
  friend constexpr Vec operator*(double s, Vec a) { return a *= s; }
  friend constexpr Vec operator-(Vec a) { return a *= -1.; }
  friend constexpr bool operator==(const Vec&, const Vec&) = default;
};

template <int Dim>
constexpr double dot(const Vec<Dim>& a, const Vec<Dim>& b) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) sum += a.c[k] * b.c[k];
  return sum;
}

template <int Dim>
double norm(const Vec<Dim>& a) {
  return std::sqrt(dot(a, a));
}

template <int Dim>
bool is_finite(const Vec<Dim>& a) {
  for (int k = 0; k < Dim; ++k) {
    if (!std::isfinite(a[k])) return false;
  }
  return true;
}

/// a/|a|, or zero when a is zero (callers decide what a missing direction means).
template <int Dim>
Vec<Dim> normalized(const Vec<Dim>& a) {
  const double length = norm(a);
  return length > 0 ? a * (1 / length) : Vec<Dim>{};
}

/// z component of a x b.
constexpr double cross(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace crampon
