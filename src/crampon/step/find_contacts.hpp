#pragma once
/// Which velocity fields face each other at the own nodes of a block, and how (N03 section 2.2; N13 sections 1.1, 1.2 and 3, step 1).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// After Task 1: the nodes with several fields, their groups, pairs, normals, gaps and areas, which hold for the whole step.
template <int Dim, class Shape>
void find_contacts(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// After Task 6: what the next step must know about every contact. Serial.
template <int Dim>
void remember_contacts(State<Dim>& state, StepWork<Dim>& work);

}  // namespace crampon
