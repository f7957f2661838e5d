#pragma once
/// Traction laws on cracks (docs/theory/traction.md): tractions are found once a step from the opening of the surfaces (Task 8) and act as
/// forces on the fields beside the crack in the next (N13 sec. 2.4).

#include <limits>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Histories of vertices, before the first step.
template <int Dim>
void start_tractions(State<Dim>& state, const Model<Dim>& model);

/// The vertex whose law bears the shortest steps.
struct StiffestVertex {
  double time_step = std::numeric_limits<double>::infinity();  ///< longest that it bears, s
  std::size_t crack = 0, vertex = 0;
};

/// Between Tasks 2 and 3: shares the forces on the surface points among the nodes that move them; finds RunClock::traction_time_step. Serial.
template <int Dim, class Shape>
StiffestVertex spread_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
