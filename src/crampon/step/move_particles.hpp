#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

// Task 5, positions: x += dt sum S v with the velocities of Task 6, or of Task 4 where there are no others (N03 Eq. 30). What positions were led on by
// before the step (lead_positions) is corrected for the velocity that moves them. Finds the box that particles now reach and their health. What
// particles remember of contact follows, too.

template <int Dim, class Shape>
void move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// After v += dt sum S a (N03 Eq. 30), where velocities are not updated before Task 6.
template <int Dim, class Shape>
void accelerate_and_move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// After the stress update of Task 6 with the nodal velocities at hand (N03 Eqs. 34-36), pack by pack.
template <int Dim, class Shape>
void update_stress_and_move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// All three.
template <int Dim, class Shape>
void update_stress_accelerate_and_move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
