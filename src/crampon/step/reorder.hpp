#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Orders particles by block, material, base node and id, and finds the blocks they need; every run is padded to whole packs.
/// Done when some particle has left its block's margin (docs/theory/space.md, order of particles). Particles marked by id == padding_id are
/// dropped. Throws RunError when a particle is out of the grid.
template <int Dim, class Shape>
void reorder(State<Dim>& state, const Model<Dim>& model);

/// Finds the box of tile nodes that a block's particles reach; what left the margin, the grid or good numbers goes to its health.
template <int Dim, class Shape>
void find_touched_box(State<Dim>& state, const Model<Dim>& model, std::size_t block, Pack lowest, Pack highest);

}  // namespace crampon
