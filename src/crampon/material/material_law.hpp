#pragma once
/// What the time step asks of a constitutive law. Calls are made per batch of packs, never per particle, so that they cost nothing
/// (docs/decisions/0004-material-dispatch.md).

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "crampon/core/pack.hpp"
#include "crampon/material/elastic_constants.hpp"
#include "crampon/material/law_contract.hpp"
#include "crampon/material/law_variable.hpp"
#include "crampon/material/stress_state.hpp"
#include "crampon/state/particles.hpp"

namespace crampon {

/// Some consecutive packs of one material. L: velocity gradient L[d * Dim + k] = dv_d/dx_k, 1/s, Dim * Dim Packs per pack.
template <int Dim>
struct StressBatch {
  int packs = 0;
  double dt = 0;            ///< s, time over which L acts
  const Pack* L = nullptr;  ///< [pack][Dim * Dim]
  Pack* stress = nullptr;   ///< [pack][stress_size]
  Pack* history = nullptr;  ///< [pack][history stride]
  int history_stride = 0;
};

class MaterialLaw {
 public:
  virtual ~MaterialLaw() = default;
  virtual std::string name() const = 0;
  virtual std::string strain_measure() const = 0;     ///< the formula of the strain that it reports
  virtual double density() const = 0;                 ///< kg/m3, initial
  virtual double wave_speed(StressState) const = 0;   ///< m/s, fastest, undeformed
  virtual int history_size(int dimension) const = 0;  ///< Packs per pack
  /// Elasticity of small strain from rest; none where it is not isotropic.
  virtual std::optional<ElasticConstants> elasticity() const = 0;
  /// Can the wave speed change as the body deforms (so that the time step must be watched)?
  virtual bool wave_speed_changes() const = 0;
  virtual Pack wave_speed(StressState, int dimension, const Pack* stress, const Pack* history) const = 0;

  /// Does it follow the deformation gradient, rather than add up small strains?
  virtual bool follows_deformation() const = 0;

  /// What the law keeps beside stress and deformation, with its place in the history.
  virtual std::span<const LawVariable> variables(int dimension) const = 0;
  /// Null where the law has no such variable.
  const LawVariable* find_variable(int dimension, std::string_view name) const {
    for (const LawVariable& v : variables(dimension)) {
      if (v.name == name) return &v;
    }
    return nullptr;
  }
  /// The energy that the law has taken, where it declares one: null for a law that gives back all work done on it.
  const LawVariable* dissipated(int dimension) const {
    for (const LawVariable& v : variables(dimension)) {
      if (v.kind == LawVariable::Kind::dissipated) return &v;
    }
    return nullptr;
  }

  virtual void initialise(int dimension, Pack* stress, Pack* history) const = 0;
  /// Advances stress and history. False when a particle turned inside out (volume ratio <= 0) or its numbers went bad.
  virtual bool update(StressState, const StressBatch<2>&) const = 0;
  virtual bool update(StressState, const StressBatch<3>&) const = 0;
  virtual PackReport report(StressState, int dimension, const Pack* stress, const Pack* history) const = 0;
  /// Deformation gradient in space, F[d * dimension + k] = dx_d/dX_k; I + strain for laws of small strain.
  virtual void deformation(StressState, int dimension, const Pack* stress, const Pack* history, Pack* F) const = 0;
};

inline bool any_positive(Pack a) { return a[0] > 0 || a[1] > 0 || a[2] > 0 || a[3] > 0; }
inline bool all_positive(Pack a) { return a[0] > 0 && a[1] > 0 && a[2] > 0 && a[3] > 0; }

/// Makes a law of a plain struct; MaterialLawContract says what the struct provides.
template <class Law>
class LawKernel final : public MaterialLaw {
  static_assert(MaterialLawContract<Law>::complete);

 public:
  explicit LawKernel(const Law& law) : law_(law) {}
  std::string name() const override { return Law::name; }
  std::string strain_measure() const override { return Law::strain_measure; }
  double density() const override { return law_.density; }
  double wave_speed(StressState s) const override { return law_.wave_speed(s); }
  std::optional<ElasticConstants> elasticity() const override { return law_.elasticity(); }
  int history_size(int dimension) const override { return dimension == 2 ? Law::template history_size<2> : Law::template history_size<3>; }
  bool wave_speed_changes() const override { return Law::wave_speed_changes; }
  Pack wave_speed(StressState s, int dimension, const Pack* stress, const Pack* history) const override {
    if constexpr (Law::wave_speed_changes) {
      return dispatch(s, dimension, [&]<int Dim, StressState S>() { return law_.template present_wave_speed<Dim, S>(stress, history); });
    } else {
      (void)dimension, (void)stress, (void)history;
      return splat(law_.wave_speed(s));
    }
  }
  bool follows_deformation() const override { return Law::starts_with_deformation_gradient; }
  std::span<const LawVariable> variables(int dimension) const override {
    return dimension == 2 ? std::span<const LawVariable>(Law::template variables<2>)
                          : std::span<const LawVariable>(Law::template variables<3>);
  }
  void initialise(int dimension, Pack* stress, Pack* history) const override {
    for (int c = 0; c < (dimension == 2 ? stress_size<2> : stress_size<3>); ++c) stress[c] = splat(0.);
    dimension == 2 ? Law::template initialise<2>(history) : Law::template initialise<3>(history);
  }
  bool update(StressState s, const StressBatch<2>& b) const override {
    return s == StressState::plane_stress ? sweep<2, StressState::plane_stress>(b) : sweep<2, StressState::plane_strain>(b);
  }
  bool update(StressState, const StressBatch<3>& b) const override { return sweep<3, StressState::three_dimensional>(b); }
  PackReport report(StressState s, int dimension, const Pack* stress, const Pack* history) const override {
    return dispatch(s, dimension, [&]<int Dim, StressState S>() { return law_.template report<Dim, S>(stress, history); });
  }
  void deformation(StressState s, int dimension, const Pack* stress, const Pack* history, Pack* F) const override {
    if constexpr (Law::starts_with_deformation_gradient) {
      std::copy_n(history, dimension * dimension, F);
    } else {
      static constexpr int at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
      const PackReport r = report(s, dimension, stress, history);
      for (int d = 0; d < dimension; ++d) {
        for (int k = 0; k < dimension; ++k) F[d * dimension + k] = r.strain[at[d][k]] + (d == k ? 1. : 0.);
      }
    }
  }

 private:
  template <int Dim, StressState S>
  bool sweep(const StressBatch<Dim>& b) const {
    Pack smallest = splat(1.);
    for (int q = 0; q < b.packs; ++q) {
      const Pack ratio =
          law_.template update<Dim, S>(b.L + q * Dim * Dim, b.dt, b.stress + q * stress_size<Dim>, b.history + q * b.history_stride);
      smallest = ratio < smallest ? ratio : (ratio == ratio ? smallest : splat(-1.));  // NaN compares with nothing
    }
    return all_positive(smallest);
  }
  template <class F>
  static auto dispatch(StressState s, int dimension, F f) {
    if (dimension == 3) return f.template operator()<3, StressState::three_dimensional>();
    if (s == StressState::plane_stress) return f.template operator()<2, StressState::plane_stress>();
    return f.template operator()<2, StressState::plane_strain>();
  }
  Law law_;
};

}  // namespace crampon
