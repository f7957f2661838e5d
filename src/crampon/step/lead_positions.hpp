#pragma once
/// Positions lead velocities by half a step, so that forces find them in the middle of the coming step (docs/theory/step.md, time of positions).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Time by which positions lead in a step of dt, s: half of it. Nothing with N03 Eq. 30, which is taken as it stands.
template <int Dim>
double position_lead(const Model<Dim>& model, double dt) {
  return model.positions == PositionUpdate::strain ? 0.5 * dt : 0.;
}

/// Before the first step of a run, and before each that is longer or shorter than the one before: takes particles, crack points and rigid bodies
/// (after start_rigid_motion) to where they are in the middle of the step. Orders particles anew where that takes them too far.
template <int Dim, class Shape>
void lead_positions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Makes ready to keep what particles move with (Particles::moved_with), where someone will look and positions lead.
template <int Dim>
void watch_motion(State<Dim>& state, StepWork<Dim>& work);

}  // namespace crampon
