#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Task 0: finds the velocity field of every pair of a particle and a node near a crack, a symmetry plane or a held face. The field follows
/// from the set of cracks that the line between the two crosses (N03 Eq. 2, N13 sec. 1.1; docs/theory/space.md, layers). Also collects
/// the normals of crossed facets per node and crack, and lays out tiles and nodes of the layers found.
/// Throws RunError when a line crosses more than Signature::capacity cracks or a block needs more than 255 layers.
template <int Dim, class Shape>
void assign_velocity_fields(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
