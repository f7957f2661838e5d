#pragma once
/// XPIC and FMPM (step/transfer.hpp): the velocities of nodes without what particles could not have given them. With A the way from nodes to
/// particles and back, A w = m^-1 S^T m S w, the terms of the series are w_1 = v, w_l = (I - A) w_(l-1), and v^(k) is the sum of the first k.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// First term, own nodes of a block: w = v at the start (XPIC) or at the end (FMPM) of the step, as Tasks 2 and 4 left it.
template <int Dim>
void start_series(StepWork<Dim>& work, std::size_t block);

/// Tile sums {m u, m} of a block's particles, u = sum S w, for term 2, 3, ...
template <int Dim, class Shape>
void project_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Own nodes of a block: the next term w - A w. Faces that Task 4 found in contact part or slide by it no more than the state of their contact
/// lets them.
template <int Dim, class Shape>
void gather_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b);
/// Adds it to the velocity that particles read. Prescribed components have none.
template <int Dim>
void add_term(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
