#pragma once
/// What the input says about meetings of bodies, as the engine wants it.

#include "crampon/input/problem.hpp"
#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// Laws and given normals for all pairs of velocity fields, conditions of rigid bodies that prescribe velocities, and where rigid bodies
/// start. `model` has its fields, rigid bodies and conditions of boundaries.
template <int Dim>
void build_contact(const Problem& problem, Model<Dim>& model, State<Dim>& state, std::vector<Diagnostic>& errors);

}  // namespace crampon
