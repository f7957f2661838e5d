#pragma once
#include <array>

#include "crampon/core/declaration.hpp"
#include "crampon/material/deformation.hpp"
#include "crampon/material/elastic_constants.hpp"
#include "crampon/material/material_law.hpp"

namespace crampon {

/// Coupled neo-Hookean solid: tau = lambda ln J I + mu (b - I), b = F F^T (docs/theory/kinematics.md, neo-Hookean solid);
/// W = mu/2 (tr b - 3 - 2 ln J) + lambda/2 (ln J)^2 per initial volume.
struct NeoHookean {
  double E = 0;        ///< Young's modulus at small strain, Pa
  double nu = 0;       ///< Poisson's ratio at small strain
  double density = 0;  ///< kg/m3

  static constexpr const char* name = "neo_hookean";
  static constexpr const char* strain_measure = "(F F^T - I) / 2";
  static const Declaration<NeoHookean>& declaration();
  /// Rubber.
  static NeoHookean example() { return {1e6, 0.45, 1000}; }
  static constexpr bool wave_speed_changes = true;
  static constexpr bool starts_with_deformation_gradient = true;
  template <int Dim>
  static constexpr int history_size = deformation_size<Dim>;
  template <int Dim>
  static constexpr std::array<LawVariable, 0> variables{};

  ElasticConstants elasticity() const { return {E, nu}; }
  double wave_speed(StressState s) const { return ElasticConstants(E, nu).wave_speed(s, density); }
  template <int Dim>
  static void initialise(Pack* F) {
    initialise_deformation<Dim>(F);
  }

  template <int Dim, StressState S>
  Pack update(const Pack* L, double dt, Pack* stress, Pack* F) const {
    const ElasticConstants c(E, nu);
    advance_deformation<Dim>(L, dt, F);
    if constexpr (S == StressState::plane_stress) {
      // tau_zz = 0: Newton for the thickness stretch, from the last one; it converges quadratically and starts close.
      const Pack log_plane = lane_log(F[0] * F[3] - F[1] * F[2]);
      Pack z = F[4];
      for (int iteration = 0; iteration < 6; ++iteration) {
        z = z - (c.lambda * (log_plane + lane_log(z)) + c.mu * (z * z - 1.)) / (c.lambda / z + 2 * c.mu * z);
      }
      F[4] = z;
    }
    const Pack J = volume_ratio_of<Dim>(F), pressure = splat(c.lambda) * lane_log(J) - c.mu, mu = splat(c.mu);
    Pack b[stress_size<Dim>];
    left_cauchy_green<Dim>(F, b);
    if constexpr (Dim == 2) {
      stress[0] = fused(mu, b[0], pressure), stress[1] = fused(mu, b[1], pressure), stress[2] = mu * b[2];
      stress[3] = S == StressState::plane_stress ? splat(0.) : fused(mu, b[3], pressure);
    } else {
      for (int k = 0; k < 3; ++k) stress[k] = fused(mu, b[k], pressure);
      for (int k = 3; k < 6; ++k) stress[k] = mu * b[k];
    }
    return J;
  }

  template <int Dim, StressState S>
  PackReport report(const Pack* /*stress*/, const Pack* F) const {
    const ElasticConstants c(E, nu);
    PackReport r{};
    Pack b[stress_size<Dim>];
    left_cauchy_green<Dim>(F, b);
    r.volume_ratio = volume_ratio_of<Dim>(F);
    r.area_ratio = area_ratio_of<Dim>(F);
    r.to_cauchy = 1. / r.volume_ratio;
    const Pack log_J = lane_log(r.volume_ratio), trace = Dim == 2 ? b[0] + b[1] + b[3] : b[0] + b[1] + b[2];
    r.energy = 0.5 * c.mu * (trace - 3. - 2. * log_J) + 0.5 * c.lambda * log_J * log_J;
    // Almansi-like measure of the same law: (b - I)/2, the small strain in the limit.
    if constexpr (Dim == 2) {
      r.strain[0] = 0.5 * (b[0] - 1.), r.strain[1] = 0.5 * (b[1] - 1.), r.strain[2] = 0.5 * (b[3] - 1.), r.strain[3] = 0.5 * b[2];
    } else {
      for (int k = 0; k < 3; ++k) r.strain[k] = 0.5 * (b[k] - 1.);
      for (int k = 3; k < 6; ++k) r.strain[k] = 0.5 * b[k];
    }
    return r;
  }

  /// Fastest wave in the present state: c^2 = (lambda + 2 (mu - lambda ln J) + tau_max)/rho0 along the longest stretch, whose
  /// square is bounded by the largest row sum of b; one stiff direction bounds plane stress too.
  template <int Dim, StressState S>
  Pack present_wave_speed(const Pack* /*stress*/, const Pack* F) const {
    const ElasticConstants c(E, nu);
    Pack b[stress_size<Dim>];
    left_cauchy_green<Dim>(F, b);
    const Pack longest = largest_row_sum<Dim>(b);
    Pack lambda = splat(c.lambda);
    if constexpr (S == StressState::plane_stress) lambda = 2 * c.lambda * c.mu * b[3] / (c.lambda + 2 * c.mu * b[3]);
    const Pack square = (lambda + c.mu + c.mu * longest - c.lambda * lane_log(volume_ratio_of<Dim>(F))) / density;
    return lane_sqrt(square);
  }
};

}  // namespace crampon
