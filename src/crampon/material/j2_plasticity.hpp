#pragma once
#include <array>

#include "crampon/core/declaration.hpp"
#include "crampon/material/deformation.hpp"
#include "crampon/material/elastic_constants.hpp"
#include "crampon/material/material_law.hpp"
#include "crampon/material/spectrum.hpp"

namespace crampon {

/// Plasticity of von Mises (J2) with linear isotropic hardening, for any stretch and any rotation (docs/decisions/0021-j2-plasticity.md,
/// docs/theory/materials.md). F = F_e F_p; elasticity is Hooke's law between the elastic Hencky strain e = ln(b_e)/2, b_e = F C_p^-1 F^T, and the
/// Kirchhoff stress: tau = lambda tr(e) I + 2 mu e. The material yields where q = sqrt(3/2 s:s) of tau reaches Y = yield_stress + H alpha, alpha the
/// equivalent plastic strain; plastic flow is normal to that surface and keeps the volume. With logarithmic strains the return to the yield surface is
/// that of small strain (Simo, CMAME 99 (1992) 61): radial in plane strain and in space; in plane stress within the plane of tau_zz = 0 (Simo & Taylor,
/// IJNME 22 (1986) 649).
/// History: F (deformation.hpp), then C_p^-1 in the order of the stress, alpha, and the plastic work per initial volume.
struct J2Plasticity {
  double E = 0;                  ///< Young's modulus, Pa
  double nu = 0;                 ///< Poisson's ratio
  double yield_stress = 0;       ///< in uniaxial tension at first yield, Kirchhoff stress, Pa
  double hardening_modulus = 0;  ///< H, rise of the yield stress per equivalent plastic strain, Pa
  double density = 0;            ///< kg/m3

  static constexpr const char* name = "j2_plasticity";
  static constexpr const char* strain_measure = "ln(F F^T) / 2";
  static const Declaration<J2Plasticity>& declaration();
  /// Structural steel.
  static J2Plasticity example() { return {210e9, 0.3, 250e6, 1e9, 7850}; }
  static constexpr bool wave_speed_changes = true;
  static constexpr bool starts_with_deformation_gradient = true;

  template <int Dim>
  static constexpr int C_at = deformation_size<Dim>;
  template <int Dim>
  static constexpr int strain_at = C_at<Dim> + stress_size<Dim>;
  template <int Dim>
  static constexpr int history_size = strain_at<Dim> + 2;
  template <int Dim>
  static constexpr std::array<LawVariable, 2> variables{
      {{"plastic_strain", "1", "equivalent plastic strain, integral of sqrt(2/3 d_p:d_p) dt", strain_at<Dim>},
       {"plastic_work", "J/m3", "work spent on plastic flow per initial volume, integral of q d(plastic_strain)", strain_at<Dim> + 1, 1,
        LawVariable::Kind::dissipated, false}}};

  ElasticConstants elasticity() const { return {E, nu}; }
  double wave_speed(StressState s) const { return ElasticConstants(E, nu).wave_speed(s, density); }
  template <int Dim>
  static void initialise(Pack* history) {
    initialise_deformation<Dim>(history);
    for (int c = C_at<Dim>; c < history_size<Dim>; ++c) history[c] = splat(0.);
    Pack* C = history + C_at<Dim>;
    C[0] = C[1] = C[Dim == 2 ? 3 : 2] = splat(1.);
  }

  template <int Dim, StressState S>
  Pack update(const Pack* L, double dt, Pack* stress, Pack* history) const {
    Pack* F = history;
    advance_deformation<Dim>(L, dt, F);
    if constexpr (S == StressState::plane_stress) {
      return_in_plane(stress, history);
    } else if constexpr (Dim == 2) {
      return_in_plane_strain(stress, history);
    } else {
      return_in_space(stress, history);
    }
    return volume_ratio_of<Dim>(F);
  }

  template <int Dim, StressState S>
  PackReport report(const Pack* stress, const Pack* F) const {
    PackReport r{};
    r.volume_ratio = volume_ratio_of<Dim>(F);
    r.area_ratio = area_ratio_of<Dim>(F);
    r.to_cauchy = 1. / r.volume_ratio;
    Pack trace = splat(0.), squares = splat(0.);
    for (int c = 0; c < stress_size<Dim>; ++c) {
      const bool normal = Dim == 2 ? c != 2 : c < 3;
      if (normal) trace += stress[c];
      squares += (normal ? 1. : 2.) * stress[c] * stress[c];
    }
    r.energy = ((1 + nu) * squares - nu * trace * trace) / (2 * E);
    Pack b[stress_size<Dim>];
    left_cauchy_green<Dim>(F, b);
    if constexpr (Dim == 2) {
      const PlaneSpectrum of(b[0], b[1], b[2]);
      const Pack first = 0.5 * lane_log(of.value[0]), second = 0.5 * lane_log(of.value[1]);
      Pack e[3];
      of.compose(first + second, first - second, e);
      r.strain[0] = e[0], r.strain[1] = e[1], r.strain[2] = lane_log(F[4]), r.strain[3] = e[2];
    } else {
      const SpaceSpectrum of(b);
      Pack e[3];
      for (int k = 0; k < 3; ++k) e[k] = 0.5 * lane_log(of.value[k]);
      of.compose(e, r.strain);
    }
    return r;
  }

  /// A bound on the fastest wave in the present state. Plastic flow makes waves slower than elastic ones. The elastic stiffness that waves meet differs from
  /// Hooke's by terms linear in stress: lambda + 2 mu - tau_11 along a principal axis, and never by more than twice the size of tau; terms of second order
  /// are those of elastic shear strains, which yielding keeps small.
  template <int Dim, StressState S>
  Pack present_wave_speed(const Pack* stress, const Pack* /*history*/) const {
    const ElasticConstants c(E, nu);
    Pack squares = splat(0.);
    for (int k = 0; k < stress_size<Dim>; ++k) squares += ((Dim == 2 ? k != 2 : k < 3) ? 1. : 2.) * stress[k] * stress[k];
    return lane_sqrt((c.plane_lambda(S) + 2 * c.mu + 2. * lane_sqrt(squares)) / density);
  }

 private:
  /// Strain of flow where q_trial is beyond the yield stress Y, with the slope of q over that strain on a radial return; zero elsewhere.
  Pack flow(Pack q_trial, Pack Y, double mu) const { return lane_max(q_trial - Y, splat(0.)) / (3 * mu + hardening_modulus); }
  /// The work of flow is that of the yield stress on its way up: no step size enters.
  void book(Pack flow, Pack* strain_and_work) const {
    strain_and_work[1] += flow * (yield_stress + hardening_modulus * (strain_and_work[0] + 0.5 * flow));
    strain_and_work[0] += flow;
  }

  /// b_e in the plane of F and C_p^-1: {xx, yy, xy}.
  static void push(const Pack* F, const Pack* C, Pack* b) {
    const Pack FC[4] = {F[0] * C[0] + F[1] * C[2], F[0] * C[2] + F[1] * C[1], F[2] * C[0] + F[3] * C[2], F[2] * C[2] + F[3] * C[1]};
    b[0] = FC[0] * F[0] + FC[1] * F[1], b[1] = FC[2] * F[2] + FC[3] * F[3], b[2] = FC[0] * F[2] + FC[1] * F[3];
  }
  /// The way back, where `flows`.
  static void pull_where(Index4 flows, const Pack* F, const Pack* b, Pack* C) {
    const Pack inverse = 1. / (F[0] * F[3] - F[1] * F[2]);
    const Pack G[4] = {F[3] * inverse, -F[1] * inverse, -F[2] * inverse, F[0] * inverse};
    Pack c[3];
    push(G, b, c);
    for (int k = 0; k < 3; ++k) C[k] = flows ? c[k] : C[k];
  }

  void return_in_plane_strain(Pack* stress, Pack* history) const {
    const ElasticConstants k(E, nu);
    const Pack* F = history;
    Pack *C = history + C_at<2>, *alpha = history + strain_at<2>;
    Pack b[3];
    push(F, C, b);
    const PlaneSpectrum of(b[0], b[1], b[2]);
    const Pack e0 = 0.5 * lane_log(of.value[0]), e1 = 0.5 * lane_log(of.value[1]), ez = 0.5 * lane_log(C[3]);
    const Pack trace = e0 + e1 + ez, mean = trace / 3.;
    Pack s0 = 2 * k.mu * (e0 - mean), s1 = 2 * k.mu * (e1 - mean), sz = 2 * k.mu * (ez - mean);
    const Pack q = lane_sqrt(1.5 * (s0 * s0 + s1 * s1 + sz * sz)), Y = yield_stress + hardening_modulus * alpha[0];
    const Pack d = flow(q, Y, k.mu);
    if (any_positive(d)) {
      const Index4 flows = d > 0.;
      const Pack left = flows ? 1. - 3 * k.mu * d / q : splat(1.);
      s0 *= left, s1 *= left, sz *= left;
      const Pack by = splat(1 / (2 * k.mu)), n0 = lane_exp(2. * (mean + by * s0)), n1 = lane_exp(2. * (mean + by * s1));
      of.compose(n0 + n1, n0 - n1, b);
      pull_where(flows, F, b, C);
      C[3] = flows ? lane_exp(2. * (mean + by * sz)) : C[3];
      book(d, alpha);
    }
    const Pack pressure = (k.lambda + 2 * k.mu / 3) * trace;
    of.compose(s0 + s1 + 2. * pressure, s0 - s1, stress);
    stress[3] = sz + pressure;
  }

  void return_in_space(Pack* stress, Pack* history) const {
    const ElasticConstants k(E, nu);
    const Pack* F = history;
    Pack *C = history + C_at<3>, *alpha = history + strain_at<3>;
    Pack b[6];
    push_in_space(F, C, b);
    const SpaceSpectrum of(b);
    Pack e[3], s[3];
    for (int i = 0; i < 3; ++i) e[i] = 0.5 * lane_log(of.value[i]);
    const Pack trace = e[0] + e[1] + e[2], mean = trace / 3.;
    for (int i = 0; i < 3; ++i) s[i] = 2 * k.mu * (e[i] - mean);
    const Pack q = lane_sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2])), Y = yield_stress + hardening_modulus * alpha[0];
    const Pack d = flow(q, Y, k.mu);
    if (any_positive(d)) {
      const Index4 flows = d > 0.;
      const Pack left = flows ? 1. - 3 * k.mu * d / q : splat(1.), by = splat(1 / (2 * k.mu));
      Pack now[3];
      for (int i = 0; i < 3; ++i) s[i] *= left, now[i] = lane_exp(2. * (mean + by * s[i]));
      of.compose(now, b);
      const Pack inverse = 1. / determinant3(F);
      Pack G[9], c[6];
      G[0] = F[4] * F[8] - F[5] * F[7], G[1] = F[2] * F[7] - F[1] * F[8], G[2] = F[1] * F[5] - F[2] * F[4];
      G[3] = F[5] * F[6] - F[3] * F[8], G[4] = F[0] * F[8] - F[2] * F[6], G[5] = F[2] * F[3] - F[0] * F[5];
      G[6] = F[3] * F[7] - F[4] * F[6], G[7] = F[1] * F[6] - F[0] * F[7], G[8] = F[0] * F[4] - F[1] * F[3];
      for (Pack& g : G) g *= inverse;
      push_in_space(G, b, c);
      for (int i = 0; i < 6; ++i) C[i] = flows ? c[i] : C[i];
      book(d, alpha);
    }
    const Pack pressure = (k.lambda + 2 * k.mu / 3) * trace;
    const Pack tau[3] = {s[0] + pressure, s[1] + pressure, s[2] + pressure};
    of.compose(tau, stress);
  }

  /// F C F^T.
  static void push_in_space(const Pack* F, const Pack* C, Pack* b) {
    const Pack full[9] = {C[0], C[3], C[5], C[3], C[1], C[4], C[5], C[4], C[2]};
    Pack FC[9];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) FC[3 * i + j] = F[3 * i] * full[j] + F[3 * i + 1] * full[3 + j] + F[3 * i + 2] * full[6 + j];
    }
    const auto at = [&](int i, int j) { return FC[3 * i] * F[3 * j] + FC[3 * i + 1] * F[3 * j + 1] + FC[3 * i + 2] * F[3 * j + 2]; };
    b[0] = at(0, 0), b[1] = at(1, 1), b[2] = at(2, 2), b[3] = at(0, 1), b[4] = at(1, 2), b[5] = at(0, 2);
  }

  /// tau_zz = 0. Sum and difference of the two principal stresses shrink each by its own rate as g, the flow over q, grows: the plane-stress projection. One
  /// number is sought, g with q(g) = Y + H g q(g).
  void return_in_plane(Pack* stress, Pack* history) const {
    const ElasticConstants k(E, nu);
    Pack *F = history, *C = history + C_at<2>, *alpha = history + strain_at<2>;
    Pack b[3];
    push(F, C, b);
    const PlaneSpectrum of(b[0], b[1], b[2]);
    const Pack e0 = 0.5 * lane_log(of.value[0]), e1 = 0.5 * lane_log(of.value[1]);
    const double of_sum = E / (1 - nu), of_difference = 2 * k.mu;
    Pack sum = of_sum * (e0 + e1), difference = of_difference * (e0 - e1);
    const Pack Y = yield_stress + hardening_modulus * alpha[0];
    const Pack q_trial = lane_sqrt(0.25 * sum * sum + 0.75 * difference * difference);
    if (any_positive(q_trial - Y)) {
      const Index4 flows = q_trial > Y;
      // h(g) = Y/q + H g - 1 rises and is concave, since 1/q is: Newton's steps from g = 0 come up to the root from below and square the error near it. The
      // largest number of steps is that of a trial stress far beyond yield with nu near -1 (j2_test); where 1/q is straight, one is enough.
      const double a = of_sum / 2, c = 1.5 * of_difference;
      Pack g = splat(0.), q = q_trial;
      for (int iteration = 0; iteration < 8; ++iteration) {
        const Pack u = 1. / (1. + a * g), v = 1. / (1. + c * g), p = 0.25 * sum * sum * u * u, d = 0.75 * difference * difference * v * v;
        q = lane_sqrt(p + d);
        const Pack slope = Y * (a * p * u + c * d * v) / (q * q * q) + hardening_modulus;
        const Pack next = g - (Y / q + hardening_modulus * g - 1.) / slope;
        g = flows ? next : g;
      }
      const Pack u = 1. / (1. + a * g), v = 1. / (1. + c * g);
      sum *= u, difference *= v;
      q = lane_sqrt(0.25 * sum * sum + 0.75 * difference * difference);
      const Pack n0 = lane_exp(sum / of_sum + difference / of_difference), n1 = lane_exp(sum / of_sum - difference / of_difference);
      of.compose(n0 + n1, n0 - n1, b);
      pull_where(flows, F, b, C);
      C[3] = flows ? C[3] * lane_exp(g * sum) : C[3];  // the thickness flows by -g sum / 2
      book(g * q, alpha);
    }
    of.compose(sum, difference, stress);
    stress[3] = splat(0.);
    F[4] = lane_exp(-nu / E * sum) / lane_sqrt(C[3]);
  }
};

}  // namespace crampon
