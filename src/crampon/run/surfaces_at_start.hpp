#pragma once
/// What contact asks of bodies: where their surfaces are before particles.

#include "crampon/input/problem.hpp"
#include "crampon/run/build_bodies.hpp"
#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// Fills Model::surface, shapes and undeformed, once particles have the stress that they bear from the start. Nothing where neither rigid
/// faces nor outlines of particles ask.
template <int Dim>
void keep_surfaces(const Problem& problem, const BuiltBodies<Dim>& bodies, const State<Dim>& state, Model<Dim>& model);

}  // namespace crampon
