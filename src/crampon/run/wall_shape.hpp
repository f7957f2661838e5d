#pragma once
/// Walls as shapes.

#include "crampon/input/problem.hpp"

namespace crampon {

/// What a [[wall]] fills: a half-plane or half-space, a disk or a ball, or all around it. dimension: 2 or 3.
RegionPtr wall_shape(const WallInput& wall, int dimension);

}  // namespace crampon
