#pragma once
#include <array>

#include "crampon/core/declaration.hpp"
#include "crampon/material/deformation.hpp"
#include "crampon/material/elastic_constants.hpp"
#include "crampon/material/material_law.hpp"

namespace crampon {

/// Isotropic elasticity, linear in the stretch and exact in rotation: W = lambda/2 (tr e)^2 + mu |e|^2 per initial volume with e = U - I and
/// F = R U, so that the Biot stress is T = lambda tr(e) I + 2 mu e and the Kirchhoff stress tau = R T U R^T = R T F^T. Found from F at once:
/// nothing drifts, and what is stored comes back. Under plane stress the stretch through the thickness is that of T_zz = 0,
/// U_zz = 1 - nu/(1 - nu) tr(e) with the trace in the plane.
struct ElasticLargeRotation {
  double E = 0;        ///< Young's modulus, Pa
  double nu = 0;       ///< Poisson's ratio
  double density = 0;  ///< kg/m3

  static constexpr const char* name = "elastic_large_rotation";
  static constexpr const char* strain_measure = "U - I";
  static const Declaration<ElasticLargeRotation>& declaration();
  /// Steel.
  static ElasticLargeRotation example() { return {210e9, 0.3, 7850}; }
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

  /// Biot strain U - I = {xx, yy, xy, zz} or {xx, yy, zz, xy, yz, xz}, and the rotation.
  template <int Dim>
  void stretch(const Pack* F, Pack* R, Pack* e) const {
    rotation_of(F, R, Dim);
    if constexpr (Dim == 2) {
      e[0] = R[0] * F[0] + R[2] * F[2] - 1.;
      e[1] = R[1] * F[1] + R[3] * F[3] - 1.;
      e[2] = R[0] * F[1] + R[2] * F[3];
      e[3] = F[4] - 1.;
    } else {
      const auto U = [&](int i, int j) { return R[i] * F[j] + R[3 + i] * F[3 + j] + R[6 + i] * F[6 + j]; };
      e[0] = U(0, 0) - 1., e[1] = U(1, 1) - 1., e[2] = U(2, 2) - 1.;
      e[3] = U(0, 1), e[4] = U(1, 2), e[5] = U(0, 2);
    }
  }

  template <int Dim, StressState S>
  Pack update(const Pack* L, double dt, Pack* stress, Pack* F) const {
    const ElasticConstants c(E, nu);
    const Pack mu2 = splat(2 * c.mu);
    advance_deformation<Dim>(L, dt, F);
    Pack R[Dim * Dim], e[stress_size<Dim>];
    stretch<Dim>(F, R, e);
    if constexpr (Dim == 2) {
      if constexpr (S == StressState::plane_stress) F[4] = 1. - nu / (1 - nu) * (e[0] + e[1]);
      const Pack pressure = splat(c.plane_lambda(S)) * (e[0] + e[1]);
      const Pack T_xx = fused(mu2, e[0], pressure), T_yy = fused(mu2, e[1], pressure), T_xy = mu2 * e[2];
      const Pack RT[4] = {R[0] * T_xx + R[1] * T_xy, R[0] * T_xy + R[1] * T_yy, R[2] * T_xx + R[3] * T_xy, R[2] * T_xy + R[3] * T_yy};
      stress[0] = RT[0] * F[0] + RT[1] * F[1];
      stress[1] = RT[2] * F[2] + RT[3] * F[3];
      stress[2] = RT[0] * F[2] + RT[1] * F[3];
      stress[3] = S == StressState::plane_stress ? splat(0.) : pressure;
    } else {
      const Pack pressure = splat(c.lambda) * (e[0] + e[1] + e[2]);
      Pack T[9];
      T[0] = fused(mu2, e[0], pressure), T[4] = fused(mu2, e[1], pressure), T[8] = fused(mu2, e[2], pressure);
      T[1] = T[3] = mu2 * e[3], T[5] = T[7] = mu2 * e[4], T[2] = T[6] = mu2 * e[5];
      Pack RT[9];
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) RT[3 * i + j] = R[3 * i] * T[j] + R[3 * i + 1] * T[3 + j] + R[3 * i + 2] * T[6 + j];
      }
      const auto tau = [&](int i, int j) { return RT[3 * i] * F[3 * j] + RT[3 * i + 1] * F[3 * j + 1] + RT[3 * i + 2] * F[3 * j + 2]; };
      stress[0] = tau(0, 0), stress[1] = tau(1, 1), stress[2] = tau(2, 2);
      stress[3] = tau(0, 1), stress[4] = tau(1, 2), stress[5] = tau(0, 2);
    }
    return volume_ratio_of<Dim>(F);
  }

  template <int Dim, StressState S>
  PackReport report(const Pack* /*stress*/, const Pack* F) const {
    const ElasticConstants c(E, nu);
    PackReport r{};
    Pack R[Dim * Dim], e[stress_size<Dim>];
    stretch<Dim>(F, R, e);
    r.volume_ratio = volume_ratio_of<Dim>(F);
    r.area_ratio = area_ratio_of<Dim>(F);
    r.to_cauchy = 1. / r.volume_ratio;
    const int n = Dim == 2 ? 2 : 3;  // in 2D nothing works through the thickness
    Pack trace = splat(0.), squares = splat(0.);
    for (int k = 0; k < n; ++k) trace += e[k], squares = fused(e[k], e[k], squares);
    for (int k = n; k < (Dim == 2 ? 3 : 6); ++k) squares = fused(2. * e[k], e[k], squares);
    r.energy = 0.5 * c.plane_lambda(S) * trace * trace + c.mu * squares;
    if constexpr (Dim == 2) {
      r.strain[0] = e[0], r.strain[1] = e[1], r.strain[2] = e[3], r.strain[3] = e[2];
    } else {
      for (int k = 0; k < 6; ++k) r.strain[k] = e[k];
    }
    return r;
  }

  /// A bound on the fastest wave in the present state, for stretches up to 3: with dF = a (x) N the energy's second variation is
  /// lambda (a.RN)^2 + 2 mu |a|^2 |N|^2 + (lambda tr e - 2 mu) dR : dF, and its last part is never more than lambda times what the first
  /// leaves of |a|^2 |N|^2; so rho0 c^2 <= (lambda + 2 mu) times the square of the longest stretch.
  template <int Dim, StressState S>
  Pack present_wave_speed(const Pack* /*stress*/, const Pack* F) const {
    Pack b[stress_size<Dim>];
    left_cauchy_green<Dim>(F, b);
    return wave_speed(S) * lane_sqrt(largest_row_sum<Dim>(b));
  }
};

}  // namespace crampon
