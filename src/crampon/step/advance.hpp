#pragma once
#include "crampon/step/crack_tractions.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/stage.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Will someone look at the state after the step? Then what particles move with is kept (Particles::moved_with).
enum class Watched { no, yes };

/// One time step of dt (s): Tasks 0 to 8 of N13 (docs/architecture.md, the time step). Throws RunError with step, time, particle and
/// advice when numbers go bad, a particle leaves the grid (unless such particles are to be removed), moves more than a cell or turns
/// inside out.
template <int Dim, class Shape>
void advance(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, double dt, Watched watched);

/// The lines of a step.
template <int Dim, class Shape>
std::vector<Stage<Dim>> stages();

/// Looks at particles and cracks as the next step will, and finds what traction laws allow for its length (RunClock::traction_time_step).
/// Without such laws it does nothing.
template <int Dim, class Shape>
StiffestVertex find_stiffest_vertex(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
