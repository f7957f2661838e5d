#pragma once
/// Rows of history.csv and events.csv from the engine's state (docs/reference/output.md).

#include <memory>
#include <vector>

#include "crampon/input/problem.hpp"
#include "crampon/output/history.hpp"
#include "crampon/run/observers/registry.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// What all observers see of a state at the present time (observers/observer.hpp). It looks at the state and the model that it was made with.
template <int Dim>
class HistorySampler {
 public:
  HistorySampler(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model) : state_(state), work_(work), model_(model) {}

  /// With the state as it is at the start of the run; observed: of that state, where observers keep what their columns go back to. Throws
  /// InputError for probes of quantities that do not exist.
  void start(const Problem& problem, Observed& observed);

  std::vector<HistoryColumn> columns() const;
  std::vector<double> row() const;  ///< SI, one value per column; the first is the time

 private:
  const State<Dim>& state_;
  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
  std::vector<std::unique_ptr<Observer<Dim>>> observers_ = make_observers<Dim>();
};

/// Columns and row of an event of a crack, for events.csv, SI.
template <int Dim>
std::vector<HistoryColumn> event_columns_of();
template <int Dim>
std::vector<double> event_row_of(const CrackEvent<Dim>& event);

}  // namespace crampon
