#include "crampon/crack/j_integral.hpp"

namespace crampon {

Vec<2> j_integral(std::span<const TipSample> samples, const TipWeight& weight, std::span<const FaceTraction> tractions,
                  std::span<const CrackSideSample> faces) {
  Vec<2> J;
  for (const TipSample& s : samples) {
    const double r = norm(s.place), q = weight.at(r);
    const Vec<2> slope = r > 0 ? s.place * (weight.slope(r) / r) : Vec<2>{};
    const double energy = s.energy + 0.5 * s.density * dot(s.velocity, s.velocity);
    for (std::size_t k = 0; k < 2; ++k) {
      double flux = -energy * slope[k], source = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        flux += dot(s.stress[i], slope) * s.gradient[i][k];
        source += s.inertia[i] * s.gradient[i][k] - s.velocity[i] * s.rate[i][k];
      }
      J[k] += s.area * (flux + s.density * source * q);
    }
  }
  for (const FaceTraction& f : tractions) J[0] += f.weight * dot(f.traction, f.opening_step);
  for (const CrackSideSample& f : faces) J += f.normal * (weight.at(norm(f.place)) * f.energy * f.length);
  return J;
}

}  // namespace crampon
