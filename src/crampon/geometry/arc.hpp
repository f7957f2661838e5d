#pragma once
/// Cracks as polylines: arcs into chords, long segments into short ones.

#include <vector>

#include "crampon/core/vector.hpp"

namespace crampon {

/// segments+1 points (m) at equal angles on a circle, from one angle (rad) to the other; to < from runs clockwise. Both end points
/// are those of their own angles, with quarter turns exact; after a full turn the last point is the first.
/// Throws std::invalid_argument unless segments >= 1 and radius > 0.
std::vector<Vec<2>> divide_arc(const Vec<2>& centre, double radius, double from, double to, int segments);

/// Smallest number of equal chords of an arc (at least 1) whose length (m) is at most max_segment > 0.
int count_arc_segments(double radius, double from, double to, double max_segment);

/// The polyline with every segment longer than max_segment (m, > 0) divided evenly. Given vertices stay bit by bit; a segment that
/// is longer by round-off alone (1e-9) stays whole. Throws std::invalid_argument unless max_segment > 0.
template <int Dim>
std::vector<Vec<Dim>> divide_polyline(const std::vector<Vec<Dim>>& points, double max_segment);

}  // namespace crampon
