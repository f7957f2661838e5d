#pragma once
/// How much of a small box a shape covers.

#include "crampon/geometry/shape.hpp"

namespace crampon {

/// Fraction of a box that a half-space covers: `distance` (m) from the box's centre to the plane, positive when the centre is outside;
/// `gradient`: of the distance, need not have length 1; half: half edge lengths, m. Only the first `dimension` axes count. Exact.
double plane_cut_fraction(double distance, const Vec<3>& gradient, const Vec<3>& half, int dimension);

/// Fraction (0 to 1) of the box centre +- half (m) that the shape covers: halved up to `depth` times, until the boundary in it is flat,
/// and cut by a plane. tolerance (m): how far outside still counts as on the boundary.
double covered_fraction(const Shape& shape, int dimension, const Vec<3>& centre, const Vec<3>& half, int depth, double tolerance);

}  // namespace crampon
