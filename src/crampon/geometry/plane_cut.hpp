#pragma once
/// How much of a small box a shape covers.

#include "crampon/geometry/region.hpp"

namespace crampon {

/// Fraction of a box that a half-space covers: `distance` (m) from the box's centre to the plane, positive when the centre is outside;
/// `gradient`: of the distance, need not have length 1; half: half edge lengths, m. Only the first `dimension` axes count. Exact.
double plane_cut_fraction(double distance, const Vec<3>& gradient, const Vec<3>& half, int dimension);

/// What a shape covers of a box.
struct CoveredPart {
  double fraction = 0;  ///< of its measure, 0 to 1
  Vec<3> moment;  ///< mean over the box of the way from its centre, where it is covered, m: fraction times the way to the part's middle
};

/// The same half-space's part of the box. The moment is exact where the fraction is.
CoveredPart plane_cut(double distance, const Vec<3>& gradient, const Vec<3>& half, int dimension);

/// The part of the box centre +- half (m) that the shape covers: halved up to `depth` times, until the boundary in it is flat,
/// and cut by a plane. tolerance (m): how far outside still counts as on the boundary.
CoveredPart covered_part(const Region& shape, int dimension, const Vec<3>& centre, const Vec<3>& half, int depth, double tolerance);

}  // namespace crampon
