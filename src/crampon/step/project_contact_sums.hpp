#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Task 1, only where fields or walls meet: tile sums of volume and its gradient, position and original position (N03 Eq. 27; N13 sec. 3).
template <int Dim, class Shape>
void project_contact_sums(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 2: adds these sums up at the own nodes of a block that hold several fields, and those of the normals of cracks.
template <int Dim, class Shape>
void assemble_contact_sums(StepWork<Dim>& work, std::size_t block);

}  // namespace crampon
