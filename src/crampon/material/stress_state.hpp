#pragma once
/// What the laws say of a pack of particles, and in which state of stress.

#include "crampon/core/pack.hpp"

namespace crampon {

/// Stress state of the model: 2D is plane strain or plane stress.
enum class StressState { plane_strain, plane_stress, three_dimensional };

/// Quantities of one pack derived from its stress and history.
struct PackReport {
  Pack energy;        ///< strain energy per initial volume, J/m3
  Pack volume_ratio;  ///< V/V0
  Pack area_ratio;    ///< A/A0 in the plane (2D); the volume ratio in 3D
  Pack to_cauchy;     ///< stored stress times this is the Cauchy stress
  Pack strain[6];     ///< xx, yy, zz, xy, yz, xz of the law's own strain measure
};

}  // namespace crampon
