#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Task 1: marks the own nodes of a block that hold several fields or are near a rigid face (BlockLayers::shared), and assembles momenta where
/// there may be some.
template <int Dim, class Shape>
void find_shared_nodes(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
