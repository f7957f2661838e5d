#pragma once
/// Cracks that lie on each other at the start: legal, and mostly a line that was copied by mistake.

#include <string>
#include <vector>

#include "crampon/state/cracks.hpp"

namespace crampon {

/// A note for each two cracks that coincide over some length; where they only cross or touch there is none. Lines less than a thousandth
/// of a cell apart coincide.
/// \param cell  smallest side of a cell, m
std::vector<std::string> overlapping_cracks(const std::vector<Crack<2>>& cracks, double cell);

}  // namespace crampon
