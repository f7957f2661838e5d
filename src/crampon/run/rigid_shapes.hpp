#pragma once
/// The rigid bodies and walls of a problem for its pictures.

#include <vector>

#include "crampon/input/problem.hpp"
#include "crampon/output/rigid_shape.hpp"

namespace crampon {

/// Rigid bodies, then walls, at the places that the frame tells; empty when it does not tell them (frames of older versions).
std::vector<RigidShape> rigid_shapes(const Problem& problem, const PointFrame& frame);

}  // namespace crampon
