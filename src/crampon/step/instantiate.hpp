#pragma once
/// The shape functions that the step is compiled for, in 2D and 3D.

#include "crampon/shape/bspline.hpp"
#include "crampon/shape/cpdi.hpp"
#include "crampon/shape/gimp.hpp"
#include "crampon/shape/linear.hpp"

/// Expands MACRO(Dim, Shape) for all of them.
#define CRAMPON_FOR_ALL_SHAPES(MACRO) \
  MACRO(2, LinearShape)               \
  MACRO(2, GimpShape)                 \
  MACRO(2, CpdiShape)                 \
  MACRO(2, BsplineShape)              \
  MACRO(3, LinearShape)               \
  MACRO(3, GimpShape)                 \
  MACRO(3, CpdiShape)                 \
  MACRO(3, BsplineShape)
