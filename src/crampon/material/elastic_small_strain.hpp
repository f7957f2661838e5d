#pragma once
#include <array>

#include "crampon/core/declaration.hpp"
#include "crampon/material/elastic_constants.hpp"
#include "crampon/material/material_law.hpp"

namespace crampon {

/// Small-strain isotropic elasticity exactly as N03: Hooke's law on the accumulated strain of Eq. 35, volume by Eq. 9, and forces
/// from the specific stress, f = -m (sigma/rho0) . G (Eq. 28): the particle's initial volume weighs the stress (conventions 43).
struct ElasticSmallStrain {
  double E = 0;        ///< Young's modulus, Pa
  double nu = 0;       ///< Poisson's ratio
  double density = 0;  ///< kg/m3

  static constexpr const char* name = "elastic_small_strain";
  static constexpr const char* strain_measure = "sum of (grad v + grad v^T) dt / 2";
  static const Declaration<ElasticSmallStrain>& declaration();
  /// Steel.
  static ElasticSmallStrain example() { return {210e9, 0.3, 7850}; }
  static constexpr bool wave_speed_changes = false;
  static constexpr bool starts_with_deformation_gradient = false;
  template <int Dim>
  static constexpr int history_size = Dim == 2 ? 4 : 6;  ///< strain: {xx, yy, xy (tensor), zz} or {xx, yy, zz, xy, yz, xz}
  template <int Dim>
  static constexpr std::array<LawVariable, 0> variables{};

  ElasticConstants elasticity() const { return {E, nu}; }
  double wave_speed(StressState s) const { return ElasticConstants(E, nu).wave_speed(s, density); }
  template <int Dim>
  static void initialise(Pack* strain) {
    for (int c = 0; c < history_size<Dim>; ++c) strain[c] = splat(0.);
  }

  template <int Dim, StressState S>
  Pack update(const Pack* L, double dt, Pack* stress, Pack* strain) const {
    const ElasticConstants c(E, nu);
    const Pack mu2 = splat(2 * c.mu), d = splat(dt);
    if constexpr (Dim == 2) {
      const Pack exx = fused(d, L[0], strain[0]), eyy = fused(d, L[3], strain[1]);  // N03 Eq. 35
      const Pack exy = fused(splat(dt / 2), L[1] + L[2], strain[2]);
      const Pack pressure = splat(c.plane_lambda(S)) * (exx + eyy);
      strain[0] = exx, strain[1] = eyy, strain[2] = exy;
      stress[0] = fused(mu2, exx, pressure);
      stress[1] = fused(mu2, eyy, pressure);
      stress[2] = mu2 * exy;
      if constexpr (S == StressState::plane_stress) {
        strain[3] = splat(-nu / (1 - nu)) * (exx + eyy);
      } else {
        stress[3] = pressure;
      }
      return (1. + exx) * (1. + eyy);  // N03 Eq. 9
    } else {
      for (int k = 0; k < 3; ++k) strain[k] = fused(d, L[4 * k], strain[k]);
      strain[3] = fused(splat(dt / 2), L[1] + L[3], strain[3]);
      strain[4] = fused(splat(dt / 2), L[5] + L[7], strain[4]);
      strain[5] = fused(splat(dt / 2), L[2] + L[6], strain[5]);
      const Pack pressure = splat(c.lambda) * (strain[0] + strain[1] + strain[2]);
      for (int k = 0; k < 3; ++k) stress[k] = fused(mu2, strain[k], pressure);
      for (int k = 3; k < 6; ++k) stress[k] = mu2 * strain[k];
      return (1. + strain[0]) * (1. + strain[1]) * (1. + strain[2]);
    }
  }

  template <int Dim, StressState S>
  PackReport report(const Pack* stress, const Pack* strain) const {
    PackReport r{};
    r.to_cauchy = splat(1.);
    if constexpr (Dim == 2) {
      // sigma_zz eps_zz vanishes in plane strain and in plane stress.
      r.energy = 0.5 * (stress[0] * strain[0] + stress[1] * strain[1]) + stress[2] * strain[2];
      r.volume_ratio = (1. + strain[0]) * (1. + strain[1]);
      r.strain[0] = strain[0], r.strain[1] = strain[1], r.strain[2] = strain[3], r.strain[3] = strain[2];
    } else {
      r.energy = 0.5 * (stress[0] * strain[0] + stress[1] * strain[1] + stress[2] * strain[2]) + stress[3] * strain[3] +
                 stress[4] * strain[4] + stress[5] * strain[5];
      r.volume_ratio = (1. + strain[0]) * (1. + strain[1]) * (1. + strain[2]);
      for (int k = 0; k < 6; ++k) r.strain[k] = strain[k];
    }
    r.area_ratio = r.volume_ratio;  // N03 Eq. 9 is of the plane
    return r;
  }
};

}  // namespace crampon
