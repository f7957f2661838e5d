#pragma once
/// Tasks 3 and 4 on the own nodes of a block: forces, new momenta, accelerations (N03 Eqs. 28, 29).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Sums the forces of tiles.
template <int Dim, class Shape>
void assemble_forces(StepWork<Dim>& work, std::size_t block);

/// f += m g - damping p, in deformable fields.
template <int Dim>
void add_body_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// p += f dt.
template <int Dim>
void add_forces(StepWork<Dim>& work, std::size_t block);

/// Work of the body force, and what damping takes, by the mean of the velocities before and after Task 4.
template <int Dim>
void account_body_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// {v', a} = {p, f}/m: what particles read in Task 5; and v' as velocities, where these are read.
template <int Dim>
void find_accelerations(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

// Where particles do more than add accelerations, half of the work of the body force in Task 4 is taken back, and half of that on the velocities of
// Task 6 comes in its place.
template <int Dim>
void take_back_body_work(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);
template <int Dim>
void add_body_work(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
