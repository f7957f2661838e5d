#include "crampon/crack/stress_intensity.hpp"

namespace crampon {

StressIntensity interaction_integral(std::span<const TipSample> samples, const VirtualExtension& extension, const TipPath& path,
                                     const SteadyTip& tip, std::span<const FaceTraction> tractions,
                                     std::span<const CrackSideSample> faces) {
  const double E = tip.elastic().modulus, c = tip.speed();
  const StressIntensity release = tip.release();
  double I[2] = {0, 0};
  // The known field opens the crack by 8/E' sqrt(r/2 pi) {A_II K_II, A_I K_I}.
  for (const FaceTraction& f : tractions) {
    const double step = 8 / E * (std::sqrt(f.near) - std::sqrt(f.far)) / std::sqrt(2 * std::numbers::pi);
    I[0] += f.weight * f.traction[1] * step * release.I;
    I[1] += f.weight * f.traction[0] * step * release.II;
  }
  for (const TipSample& s : samples) {
    const double r = norm(s.place);
    if (!(r > 0)) continue;
    const VirtualExtension::Shift shift = extension.at(s.place);
    const double theta = path.direction(s.place);
    for (int mode = 0; mode < 2; ++mode) {
      const TipField known = tip.field(mode == 0 ? StressIntensity{1, 0} : StressIntensity{0, 1}, r, theta);
      double work = 0, flux = 0, inertia = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        // The known velocity is -c u*_i,1. Of a tip that moves as the known field does, both terms with c are nothing where fields are strongest.
        work += dot(s.stress[i], known.gradient[i]) - s.density * c * s.velocity[i] * known.gradient[i][0];
        inertia += s.inertia[i] * dot(known.gradient[i], shift.q) +
                   c * (s.rate[i][0] * known.gradient[i][0] + (s.velocity[i] + c * s.gradient[i][0]) * known.second[i]) * shift.q[0];
      }
      for (std::size_t k = 0; k < 2; ++k) {
        flux -= work * shift.gradient[k][k];
        for (std::size_t i = 0; i < 2; ++i)
          flux += dot(s.stress[i], shift.gradient[k]) * known.gradient[i][k] + dot(known.stress[i], shift.gradient[k]) * s.gradient[i][k];
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
      const TipField known = tip.field(mode == 0 ? StressIntensity{1, 0} : StressIntensity{0, 1}, r, theta);
      double work = 0, across = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        work += dot(f.stress[i], known.gradient[i]) - c * f.momentum[i] * known.gradient[i][0];
        across += dot(known.stress[i], f.normal) * dot(f.gradient[i], q);
      }
      I[mode] += (work * dot(f.normal, q) - across) * f.length;
    }
  }
  return {0.5 * E * I[0] / release.I, 0.5 * E * I[1] / release.II};
}

StressIntensity share(double J, const StressIntensity& proportion, const SteadyTip& tip) {
  const StressIntensity A = tip.release();
  const double size = std::hypot(std::sqrt(A.I) * proportion.I, std::sqrt(A.II) * proportion.II);
  if (!(size > 0) || !(J > 0)) return {};
  const double K = std::sqrt(tip.elastic().modulus * J);
  return {K * proportion.I / size, K * proportion.II / size};
}

StressIntensity partition_by_opening(double J, const Vec<2>& opening, const SteadyTip& tip) {
  return share(J, {std::fmax(opening[1], 0) / tip.release().I, opening[0] / tip.release().II}, tip);
}

}  // namespace crampon
