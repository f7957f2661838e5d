#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Orders particles by block, material, base node and id, and finds the blocks they need; every run is padded to whole packs.
/// Done when some particle has left its block's margin (docs/theory/space.md, order of particles). Particles marked by id == padding_id are
/// dropped. Throws RunError when a particle is out of the grid.
template <int Dim, class Shape>
void reorder(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Builds what follows from the order of particles: blocks, who refers to them or to particles' places, and the boxes that particles reach. For a
/// state that was saved and loaded this is all that there is to do.
template <int Dim, class Shape>
void lay_out_blocks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Finds the box of tile nodes that a block's particles reach; what left the margin, the grid or good numbers goes to its health.
template <int Dim, class Shape>
void find_touched_box(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, Pack lowest, Pack highest);

}  // namespace crampon
