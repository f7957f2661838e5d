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

StressIntensity interaction_integral(std::span<const TipSample> samples, const VirtualExtension& extension, const TipPath& path,
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
    const VirtualExtension::Shift shift = extension.at(s.place);
    const double theta = path.direction(s.place);
    for (int mode = 0; mode < 2; ++mode) {
      const TipField known = tip_field(elastic, mode == 0 ? StressIntensity{1, 0} : StressIntensity{0, 1}, r, theta);
      const double work = dot(s.stress[0], known.gradient[0]) + dot(s.stress[1], known.gradient[1]);
      double flux = 0, inertia = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        flux -= work * shift.gradient[k][k];
        for (std::size_t i = 0; i < 2; ++i) {
          flux += dot(s.stress[i], shift.gradient[k]) * known.gradient[i][k] + dot(known.stress[i], shift.gradient[k]) * s.gradient[i][k];
          inertia += s.inertia[i] * known.gradient[i][k] * shift.q[k];
        }
      }
      I[mode] += s.area * (flux + s.density * inertia);
    }
  }
  // Where the path bends, the known field has tractions on the faces.
  for (const CrackSideSample& f : faces) {
    const double r = norm(f.place), theta = path.angle(r) - (f.is_left ? 0 : 2 * std::numbers::pi);
    const Vec<2> q = extension.at(f.place).q;
    if (!(r > 0) || norm(q) == 0) continue;
    for (int mode = 0; mode < 2; ++mode) {
      const TipField known = tip_field(elastic, mode == 0 ? StressIntensity{1, 0} : StressIntensity{0, 1}, r, theta);
      double work = 0, across = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        work += dot(f.stress[i], known.gradient[i]);
        across += dot(known.stress[i], f.normal) * dot(f.gradient[i], q);
      }
      I[mode] += (work * dot(f.normal, q) - across) * f.length;
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
