#pragma once
/// What is told at the end of a run about bodies that have stretched more than their shape functions bear.

#include <optional>
#include <string>

#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// Stretch from which on bars of uGIMP, B-splines and linear functions may tear by themselves (docs/theory/step.md, large stretch).
constexpr double large_stretch = 1.2;

/// Names the particle with the largest stretch, if that is large and the domains of particles do not stretch with them. The stretch of a particle is the
/// largest singular value of its deformation gradient.
template <int Dim>
std::optional<std::string> tell_large_stretch(const State<Dim>& state, const Model<Dim>& model);

}  // namespace crampon
