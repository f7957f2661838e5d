#pragma once
/// The material of rigid bodies: no stress, whatever happens. Not one of the input's laws: the input says [[rigid]].

#include "crampon/material/material_law.hpp"

namespace crampon {

/// Its mass is its volume, 1 kg/m3, so that sums of mass over a rigid body's particles are sums of volume (N13 sec. 3).
class RigidMaterial final : public MaterialLaw {
 public:
  std::string name() const override { return "rigid"; }
  std::string strain_measure() const override { return "0"; }
  double density() const override { return 1; }
  double wave_speed(StressState) const override { return 0; }
  std::optional<ElasticConstants> elasticity() const override { return std::nullopt; }
  int history_size(int) const override { return 0; }
  bool wave_speed_changes() const override { return false; }
  bool follows_deformation() const override { return false; }
  std::span<const LawVariable> variables(int) const override { return {}; }
  Pack wave_speed(StressState, int, const Pack*, const Pack*) const override { return splat(0.); }
  void initialise(int dimension, Pack* stress, Pack*) const override {
    for (int c = 0; c < (dimension == 2 ? stress_size<2> : stress_size<3>); ++c) stress[c] = splat(0.);
  }
  bool update(StressState, const StressBatch<2>&) const override { return true; }
  bool update(StressState, const StressBatch<3>&) const override { return true; }
  PackReport report(StressState, int, const Pack*, const Pack*) const override {
    PackReport r{};
    r.volume_ratio = r.area_ratio = r.to_cauchy = splat(1.);
    return r;
  }
  void deformation(StressState, int dimension, const Pack*, const Pack*, Pack* F) const override {
    for (int i = 0; i < dimension * dimension; ++i) F[i] = splat(i % (dimension + 1) == 0 ? 1. : 0.);
  }
};

}  // namespace crampon
