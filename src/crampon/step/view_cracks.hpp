#pragma once
/// Task 0: the cracks as the crossing tests see them, together with their images in symmetry planes.

#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Fills State::crack_view. `reach`: how many cells beyond its own a particle has nodes.
void view_cracks(State<2>& state, const Model<2>& model, int reach);

/// By which crack the node in the mirror is parted from a particle that crosses `crack` on its way to the node beyond the plane: a crack and
/// its image change places.
CrackId seen_in_mirror(const CrackView& view, CrackId crack, std::size_t plane);

}  // namespace crampon
