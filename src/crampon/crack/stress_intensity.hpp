#pragma once
#include <span>

#include "crampon/crack/j_integral.hpp"
#include "crampon/crack/tip_domain.hpp"

namespace crampon {

/// Isotropic elasticity of the plane at small strain.
struct PlaneElasticity {
  double shear = 0;    ///< mu, Pa
  double kappa = 0;    ///< 3 - 4 nu in plane strain, (3 - nu)/(1 + nu) in plane stress
  double modulus = 0;  ///< E', Pa: E/(1 - nu^2) in plane strain, E in plane stress

  PlaneElasticity() = default;
  /// lambda: of the plane, Pa (ElasticConstants::plane_lambda).
  PlaneElasticity(double lambda, double mu)
      : shear(mu), kappa((lambda + 3 * mu) / (lambda + mu)), modulus(4 * mu * (lambda + mu) / (lambda + 2 * mu)) {}
};

/// Opening and sliding intensity, Pa sqrt(m).
struct StressIntensity {
  double I = 0, II = 0;
};

/// Gradient u_i,k and stress, Pa, of the field about a tip at rest, with stress intensities K (Williams).
struct TipField {
  Tensor2 gradient{}, stress{};
};
TipField tip_field(const PlaneElasticity& elastic, const StressIntensity& K, double r, double theta);

/// By the interaction integral: J of the sum of the fields and a known field, less J of each (docs/theory/fracture.md, stress intensities).
StressIntensity interaction_integral(std::span<const TipSample> samples, const VirtualExtension& extension, const TipPath& path,
                                     const PlaneElasticity& elastic, std::span<const FaceTraction> tractions,
                                     std::span<const CrackSideSample> faces = {});

/// J in the proportion of two intensities: J says how large they are together, G = (K_I^2 + K_II^2)/E'. It does not depend on where exactly the
/// tip is taken to be, as the interaction integral does. Without J both are zero.
StressIntensity share(double J, const StressIntensity& proportion, const PlaneElasticity& elastic);

/// By the opening behind the tip: J divided in the proportion of opening and sliding (docs/theory/fracture.md, stress intensities). opening: in the frame of
/// the tip, {sliding, opening}, m, of the side to the left. Without an opening both are zero. A closed crack has no opening intensity.
StressIntensity partition_by_opening(double J, const Vec<2>& opening, const PlaneElasticity& elastic);

}  // namespace crampon
