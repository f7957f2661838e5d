#pragma once
/// The family of shapes as an input names them.

#include "crampon/core/declaration.hpp"
#include "crampon/geometry/region.hpp"

namespace crampon {

/// shape = { kind = "disk", centre = [0, 0], radius = "5 mm" }. Points have two numbers in 2D and three in 3D; whether a shape suits the
/// dimension of the problem is told by Region::dimension().
const Family<RegionPtr>& shapes();

}  // namespace crampon
