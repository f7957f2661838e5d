#pragma once
/// Momenta and velocities of a block's own nodes: sums of the tiles about them.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Sums the momenta and masses of tiles.
template <int Dim, class Shape>
void assemble_momentum(StepWork<Dim>& work, std::size_t block);

/// Tasks 1 and 2: momenta at the start of the step (N03 Eq. 26), with the rotation that they carry.
template <int Dim, class Shape>
void assemble_start_momenta(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 6: the re-extrapolated momenta (N03 Eq. 31).
template <int Dim, class Shape>
void assemble_end_momenta(State<Dim>& state, StepWork<Dim>& work, std::size_t block);

/// v = p/m, zero where there is no mass: what the next stress update reads.
template <int Dim>
void find_velocities(StepWork<Dim>& work, std::size_t block);

/// Task 6: particles are to move with the nodal velocities at hand, and as far as springs between them give way; not where N03 Eq. 30 is chosen.
template <int Dim>
void move_with_velocities(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
