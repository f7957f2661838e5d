#pragma once
/// Where a body fills space, as its nodes see it.

#include <cstdint>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Mass about x over what a body at rest would have there: 1 inside, a half on a straight edge. Of the piece of material to which `material` belongs.
double filled(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x, std::uint32_t material);

/// How far a path that leaves its body at x in the direction e goes on for those who ask what it cuts, m: as far as lines from particles to nodes reach
/// (m), but not into another body.
double extension_beyond(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x, const Vec<2>& e, std::uint32_t material,
                        double reach);

}  // namespace crampon
