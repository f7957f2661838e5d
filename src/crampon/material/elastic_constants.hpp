#pragma once
#include <cmath>

#include "crampon/material/stress_state.hpp"

namespace crampon {

/// Lame constants from E and nu, Pa.
struct ElasticConstants {
  double lambda = 0, mu = 0;
  ElasticConstants() = default;
  ElasticConstants(double E, double nu) : lambda(E * nu / ((1 + nu) * (1 - 2 * nu))), mu(E / (2 * (1 + nu))) {}
  bool operator==(const ElasticConstants&) const = default;
  /// lambda of the reduced law in plane stress (docs/theory/kinematics.md, elasticity with large rotation).
  double plane_lambda(StressState s) const { return s == StressState::plane_stress ? 2 * lambda * mu / (lambda + 2 * mu) : lambda; }
  /// Fastest wave of small amplitude, m/s (docs/theory/kinematics.md, waves and the time step).
  double wave_speed(StressState s, double density) const { return std::sqrt((plane_lambda(s) + 2 * mu) / density); }
};

}  // namespace crampon
