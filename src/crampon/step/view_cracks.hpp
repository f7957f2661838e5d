#pragma once
/// Task 0: the cracks as the crossing tests see them, together with their images in symmetry planes.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Fills StepWork::crack_view. `reach`: how many cells beyond its own a particle has nodes.
template <int Dim>
void view_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, int reach);

/// A line from a particle to a node beyond a symmetry plane crosses `crack`. Mirrored in the plane, the line ends at the mirror node, and
/// it crosses the image of the crack. Returns this image, by which the pair is parted from the mirror node. The image of an image is the
/// crack itself.
template <int Dim>
CrackId seen_in_mirror(const CrackView<Dim>& view, CrackId crack, std::size_t plane);

}  // namespace crampon
