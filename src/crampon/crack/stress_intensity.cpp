#include "crampon/crack/stress_intensity.hpp"

namespace crampon {

TipField tip_field(const PlaneElasticity& elastic, const StressIntensity& K, double r, double theta) {
  const double c = std::cos(theta), s = std::sin(theta), ch = std::cos(theta / 2), sh = std::sin(theta / 2), kappa = elastic.kappa;
  // u_i = sqrt(r) f_i(theta) / (2 mu sqrt(2 pi)), and its derivative along theta.
  const double f[2] = {K.I * ch * (kappa - c) + K.II * sh * (kappa + 2 + c), K.I * sh * (kappa - c) - K.II * ch * (kappa - 2 + c)};
  const double df[2] = {K.I * (-0.5 * sh * (kappa - c) + ch * s) + K.II * (0.5 * ch * (kappa + 2 + c) - sh * s),
                        K.I * (0.5 * ch * (kappa - c) + sh * s) + K.II * (0.5 * sh * (kappa - 2 + c) + ch * s)};
  const double size = 1 / (2 * elastic.shear * std::sqrt(2 * std::numbers::pi * r));
  TipField field;
  for (std::size_t i = 0; i < 2; ++i) field.gradient[i] = Vec<2>{{0.5 * c * f[i] - s * df[i], 0.5 * s * f[i] + c * df[i]}} * size;
  const double lambda = elastic.shear * (3 - elastic.kappa) / (elastic.kappa - 1);
  const Tensor2& g = field.gradient;
  const double pressure = lambda * (g[0][0] + g[1][1]), shear = elastic.shear * (g[0][1] + g[1][0]);
  field.stress = {Vec<2>{{pressure + 2 * elastic.shear * g[0][0], shear}}, Vec<2>{{shear, pressure + 2 * elastic.shear * g[1][1]}}};
  return field;
}

StressIntensity interaction_integral(std::span<const TipSample> samples, const TipWeight& weight, const TipPath& path,
                                     const PlaneElasticity& elastic, std::span<const FaceTraction> tractions,
                                     std::span<const CrackSideSample> faces) {
  double I[2] = {0, 0};
  // The known field opens the crack by (kappa + 1)/mu sqrt(r/2 pi) {K_II, K_I}.
  for (const FaceTraction& f : tractions) {
    const double step = (elastic.kappa + 1) / elastic.shear * (std::sqrt(f.near) - std::sqrt(f.far)) / std::sqrt(2 * std::numbers::pi);
    I[0] += f.weight * f.traction[1] * step;
    I[1] += f.weight * f.traction[0] * step;
  }
  for (const TipSample& s : samples) {
    const double r = norm(s.place);
    if (!(r > 0)) continue;
    const double q = weight.at(r), theta = path.direction(s.place);
    const Vec<2> slope = s.place * (weight.slope(r) / r);
    for (int mode = 0; mode < 2; ++mode) {
      const TipField known = tip_field(elastic, mode == 0 ? StressIntensity{1, 0} : StressIntensity{0, 1}, r, theta);
      double flux = 0, work = 0, inertia = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        flux += dot(s.stress[i], slope) * known.gradient[i][0] + dot(known.stress[i], slope) * s.gradient[i][0];
        work += dot(s.stress[i], known.gradient[i]);
        inertia += s.inertia[i] * known.gradient[i][0];
      }
      I[mode] += s.area * (flux - work * slope[0] + s.density * inertia * q);
    }
  }
  // Where the path bends, the known field has tractions on the faces.
  for (const CrackSideSample& f : faces) {
    const double r = norm(f.place), q = weight.at(r), theta = path.angle(r) - (f.is_left ? 0 : 2 * std::numbers::pi);
    if (!(r > 0) || q == 0) continue;
    for (int mode = 0; mode < 2; ++mode) {
      const TipField known = tip_field(elastic, mode == 0 ? StressIntensity{1, 0} : StressIntensity{0, 1}, r, theta);
      double work = 0, across = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        work += dot(f.stress[i], known.gradient[i]);
        across += dot(known.stress[i], f.normal) * f.gradient[i][0];
      }
      I[mode] += (work * f.normal[0] - across) * q * f.length;
    }
  }
  return {0.5 * elastic.modulus * I[0], 0.5 * elastic.modulus * I[1]};
}

StressIntensity share(double J, const StressIntensity& proportion, const PlaneElasticity& elastic) {
  const double size = std::hypot(proportion.I, proportion.II);
  if (!(size > 0) || !(J > 0)) return {};
  const double K = std::sqrt(elastic.modulus * J);
  return {K * proportion.I / size, K * proportion.II / size};
}

StressIntensity partition_by_opening(double J, const Vec<2>& opening, const PlaneElasticity& elastic) {
  return share(J, {std::fmax(opening[1], 0), opening[0]}, elastic);
}

}  // namespace crampon
