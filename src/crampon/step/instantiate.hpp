#pragma once
/// The shape functions that the step is compiled for, in 2D and 3D: all of the list.

#include "crampon/shape/registry.hpp"

#define CRAMPON_IN_PLANE_AND_SPACE(SHAPE, MACRO) MACRO(2, SHAPE) MACRO(3, SHAPE)

/// Expands MACRO(Dim, Shape) for all of them.
#define CRAMPON_FOR_ALL_SHAPES(MACRO) CRAMPON_SHAPES(CRAMPON_IN_PLANE_AND_SPACE, MACRO)
