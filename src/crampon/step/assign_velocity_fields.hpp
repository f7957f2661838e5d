#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Task 0: for every pair of a particle and a node near a crack, a symmetry plane or a held face, where it goes: the velocity field it belongs to: the set of
/// cracks that the line between them crosses (N03 Eq. 2, N13 sec. 1.1, DESIGN section 2). Also collects the normals of crossed
/// segments per node and crack, and lays out tiles and nodes of the layers found.
/// Throws RunError when a line crosses more than Signature::capacity cracks or a block needs more than 255 layers.
template <int Dim, class Shape>
void assign_velocity_fields(State<Dim>& state, const Model<Dim>& model, double dt);

}  // namespace crampon
