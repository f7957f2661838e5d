#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Task 1: tile sums of m v S and m S per layer (N03 Eq. 26), for one block.
template <int Dim, class Shape>
void project_momentum(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
