#pragma once
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Sums the momenta and masses of tiles at the own nodes of a block.
template <int Dim, class Shape>
void assemble_momentum(StepWork<Dim>& work, std::size_t block);

}  // namespace crampon
