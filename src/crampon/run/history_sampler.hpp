#pragma once
/// Rows of history.csv and events.csv from the engine's state (docs/reference/output.md).

#include <cstdint>
#include <string>
#include <vector>

#include "crampon/input/problem.hpp"
#include "crampon/output/history.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Sums, reactions, openings and probes of a state at the present time. It looks at the state and the model that it was made with.
template <int Dim>
class HistorySampler {
 public:
  HistorySampler(const State<Dim>& state, const Model<Dim>& model) : state_(state), model_(model) {}

  /// With the state as it is at the start of the run: the energy that the balance begins with, and the particles that probes follow.
  /// cracked: BuiltModel::cracked. Throws InputError for probes of quantities that do not exist.
  void start(const Problem& problem, std::vector<std::vector<bool>> cracked);

  std::vector<HistoryColumn> columns() const;
  std::vector<double> row() const;  ///< SI, one value per column; the first is the time

 private:
  struct Probe {
    std::string name, quantity;
    std::uint32_t particle = 0;  ///< id
  };
  const State<Dim>& state_;
  const Model<Dim>& model_;
  double initial_energy_ = 0;  ///< J
  std::vector<std::vector<bool>> cracked_;
  std::vector<Probe> probes_;
};

/// Columns and row of a failure, for events.csv, SI.
template <int Dim>
std::vector<HistoryColumn> event_columns_of();
template <int Dim>
std::vector<double> event_row_of(const FailureEvent<Dim>& event);

}  // namespace crampon
