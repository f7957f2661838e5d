#include "crampon/crack/tip_field.hpp"

#include <complex>
#include <limits>

namespace crampon {

namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};

/// Stress, Pa, of a displacement gradient.
Tensor2 stress_of(const PlaneElasticity& elastic, const Tensor2& g) {
  const double lambda = elastic.shear * (3 - elastic.kappa) / (elastic.kappa - 1);
  const double pressure = lambda * (g[0][0] + g[1][1]), shear = elastic.shear * (g[0][1] + g[1][0]);
  return {Vec<2>{{pressure + 2 * elastic.shear * g[0][0], shear}}, Vec<2>{{shear, pressure + 2 * elastic.shear * g[1][1]}}};
}

/// The square root of x + i a y that turns with theta, however often the path of the crack has turned.
Complex root(double a, double r, double theta) {
  const double x = r * std::cos(theta), y = a * r * std::sin(theta), turn = 2 * std::numbers::pi;
  double angle = std::atan2(y, x);
  angle += turn * std::round((theta - angle) / turn);
  return std::polar(std::sqrt(std::hypot(x, y)), 0.5 * angle);
}

}  // namespace

TipField tip_field(const PlaneElasticity& elastic, const StressIntensity& K, double r, double theta) {
  const double c = std::cos(theta), s = std::sin(theta), ch = std::cos(theta / 2), sh = std::sin(theta / 2), kappa = elastic.kappa;
  // u_i = sqrt(r) f_i(theta) / (2 mu sqrt(2 pi)), and its derivative along theta.
  const double f[2] = {K.I * ch * (kappa - c) + K.II * sh * (kappa + 2 + c), K.I * sh * (kappa - c) - K.II * ch * (kappa - 2 + c)};
  const double df[2] = {K.I * (-0.5 * sh * (kappa - c) + ch * s) + K.II * (0.5 * ch * (kappa + 2 + c) - sh * s),
                        K.I * (0.5 * ch * (kappa - c) + sh * s) + K.II * (0.5 * sh * (kappa - 2 + c) + ch * s)};
  const double size = 1 / (2 * elastic.shear * std::sqrt(2 * std::numbers::pi * r));
  TipField field;
  for (std::size_t k = 0; k < 2; ++k) field.gradient[k] = Vec<2>{{0.5 * c * f[k] - s * df[k], 0.5 * s * f[k] + c * df[k]}} * size;
  field.stress = stress_of(elastic, field.gradient);
  return field;
}

SteadyTip::SteadyTip(const PlaneElasticity& elastic, double density, double speed) : elastic_(elastic), speed_(speed) {
  // (v/c_s)^2 and (c_s/c_d)^2. D = 4 d s - (1 + s^2)^2 is small at small speeds; as (v/c_s)^2 * rayleigh / sum it does not lose its digits.
  const double part = density * speed * speed / elastic.shear, slower = (elastic.kappa - 1) / (elastic.kappa + 1);
  const double rayleigh = 16 * (1 - slower) - part * (24 - 16 * slower - part * (8 - part));
  rests_ = part < 1e-8;  // the field differs from that at rest by so much
  is_slow_ = part < 1 && rayleigh > 0;
  if (!is_slow_) {
    release_ = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    return;
  }
  if (rests_) return;
  d_ = std::sqrt(1 - part * slower), s_ = std::sqrt(1 - part);
  const double sum = 4 * d_ * s_ + (2 - part) * (2 - part), common = 4 * sum / ((elastic.kappa + 1) * rayleigh);
  release_ = {d_ * common, s_ * common};
  size_ = 2 * sum / (elastic.shear * std::sqrt(2 * std::numbers::pi) * part * rayleigh);
}

TipField SteadyTip::field(const StressIntensity& K, double r, double theta) const {
  if (rests_) return tip_field(elastic_, K, r, theta);
  // u_k is the real part of p_k sqrt(x + i d y) + q_k sqrt(x + i s y).
  const double e = 1 + s_ * s_;
  const Complex p[2] = {size_ * (K.I * e - 2. * i * K.II * s_), size_ * d_ * (i * K.I * e + 2 * K.II * s_)};
  const Complex q[2] = {size_ * s_ * (-2 * K.I * d_ + i * K.II * e), size_ * (-2. * i * K.I * d_ - K.II * e)};
  const Complex of_d = root(d_, r, theta), of_s = root(s_, r, theta);
  TipField field;
  for (std::size_t k = 0; k < 2; ++k) {
    const Complex pressure = 0.5 * p[k] / of_d, shear = 0.5 * q[k] / of_s;
    field.gradient[k] = {{(pressure + shear).real(), (i * d_ * pressure + i * s_ * shear).real()}};
    field.second[k] = -0.5 * (pressure / (of_d * of_d) + shear / (of_s * of_s)).real();
  }
  field.stress = stress_of(elastic_, field.gradient);
  return field;
}

}  // namespace crampon
