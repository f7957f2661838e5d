#pragma once
/// What fills history.csv: observers look at the state at the times of its rows. Each is one file of this folder with one line in registry.cpp.

#include <optional>
#include <vector>

#include "crampon/core/error.hpp"
#include "crampon/input/problem.hpp"
#include "crampon/run/observers/column.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/particle_sums.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// State and model at the time of a row.
template <int Dim>
class Present {
 public:
  Present(const State<Dim>& of_state, const StepWork<Dim>& of_work, const Model<Dim>& of_model)
      : state(of_state), work(of_work), model(of_model) {}
  /// Sums over all particles, found when first asked for.
  const ParticleSums<Dim>& sums() const {
    if (!sums_) sums_ = sum_particles(state, model);
    return *sums_;
  }

  const State<Dim>& state;
  const StepWork<Dim>& work;
  const Model<Dim>& model;

 private:
  mutable std::optional<ParticleSums<Dim>> sums_;
};

/// The start of a run.
template <int Dim>
struct StartOfRun {
  const Problem& problem;
  const Present<Dim>& now;
  Observed& observed;               ///< where observers keep what their columns go back to
  std::vector<Diagnostic>& errors;  ///< what observers find wrong with the input
};

template <int Dim>
class Observer {
 public:
  virtual ~Observer() = default;
  /// Once, before the first step.
  virtual void start(const StartOfRun<Dim>&) {}
  /// The same cells in the same order at any time of a run.
  virtual void look(const Present<Dim>& now, Cells& cells) const = 0;
};

}  // namespace crampon
