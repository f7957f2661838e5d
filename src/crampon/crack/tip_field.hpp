#pragma once
/// The field about the tip of a crack in an isotropic elastic body, at rest or on its way.

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

/// Gradient u_i,k and stress, Pa, and the second derivative of u along the first axis, 1/m.
struct TipField {
  Tensor2 gradient{}, stress{};
  Vec<2> second;
};

/// Of a tip at rest, with stress intensities K (Williams); without the second derivative.
TipField tip_field(const PlaneElasticity& elastic, const StressIntensity& K, double r, double theta);

/// A tip that moves steadily along its first axis, or rests.
class SteadyTip {
 public:
  /// At rest.
  SteadyTip(const PlaneElasticity& elastic) : SteadyTip(elastic, 0, 0) {}
  /// density: kg/m3; speed: m/s.
  SteadyTip(const PlaneElasticity& elastic, double density, double speed);

  /// Is it slower than Rayleigh waves? A faster one has no field with intensities.
  bool is_slow() const { return is_slow_; }
  double speed() const { return speed_; }
  const PlaneElasticity& elastic() const { return elastic_; }
  /// A_I and A_II of G = (A_I K_I^2 + A_II K_II^2)/E': 1 at rest, without bound as the speed nears that of Rayleigh waves (Freund, Dynamic Fracture
  /// Mechanics, sec. 5.3). Opening and sliding behind the tip are larger by them than those of a tip at rest.
  StressIntensity release() const { return release_; }
  /// As tip_field(), of the tip on its way (Freund, sec. 4.3).
  TipField field(const StressIntensity& K, double r, double theta) const;

 private:
  PlaneElasticity elastic_;
  double speed_ = 0;
  bool is_slow_ = true, rests_ = true;
  double d_ = 1, s_ = 1;  ///< sqrt(1 - v^2/c^2) of pressure and shear waves
  double size_ = 0;       ///< 2/(mu sqrt(2 pi) D), 1/Pa
  StressIntensity release_{1, 1};
};

}  // namespace crampon
