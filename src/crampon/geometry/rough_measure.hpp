#pragma once
/// Area or volume of a shape at a glance.

#include "crampon/geometry/region.hpp"

namespace crampon {

/// Measure (m2 or m3) of the part of a shape within a box (m; in 2D its z range is unused), from some thousand distances: within a few
/// per cent of that of a compact shape. At least what is measured of shapes without extent: zero.
double rough_measure(const Region& shape, int dimension, const Bounds3& box);

}  // namespace crampon
