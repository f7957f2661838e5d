#include "crampon/crack/j_integral.hpp"

namespace crampon {

Vec<2> j_integral(std::span<const TipSample> samples, const VirtualExtension& extension, std::span<const FaceTraction> tractions,
                  std::span<const CrackSideSample> faces) {
  const TipWeight& weight = extension.weight();
  Vec<2> J;
  for (const TipSample& s : samples) {
    const VirtualExtension::Shift along = extension.at(s.place);
    const double r = norm(s.place);
    const VirtualExtension::Shift across{{{0, weight.at(r)}}, {Vec<2>{}, r > 0 ? s.place * (weight.slope(r) / r) : Vec<2>{}}};
    const double energy = s.energy + 0.5 * s.density * dot(s.velocity, s.velocity);
    for (std::size_t component = 0; component < 2; ++component) {
      const VirtualExtension::Shift& shift = component == 0 ? along : across;
      double flux = 0, source = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        flux -= energy * shift.gradient[k][k];
        for (std::size_t i = 0; i < 2; ++i) {
          flux += dot(s.stress[i], shift.gradient[k]) * s.gradient[i][k];
          source += (s.inertia[i] * s.gradient[i][k] - s.velocity[i] * s.rate[i][k]) * shift.q[k];
        }
      }
      J[component] += s.area * (flux + s.density * source);
    }
  }
  for (const FaceTraction& f : tractions) J[0] += f.weight * dot(f.traction, f.opening_step);
  for (const CrackSideSample& f : faces) J[1] += f.normal[1] * weight.at(norm(f.place)) * f.energy * f.length;
  return J;
}

}  // namespace crampon
