#pragma once
/// Blocks as the order of particles has them (docs/theory/space.md), and the parts of their tiles that particles reach.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Builds what follows from the order of particles: blocks, who refers to them or to particles' places, and the boxes that particles reach. For a
/// state that was saved and loaded this is all that there is to do.
template <int Dim, class Shape>
void lay_out_blocks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Finds the box of tile nodes that a block's particles reach; what left the margin, the grid or good numbers goes to its health.
template <int Dim, class Shape>
void find_touched_box(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, Pack lowest, Pack highest);

}  // namespace crampon
