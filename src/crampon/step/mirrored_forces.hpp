#pragma once
/// Forces, works and reactions of folded pairs (step/folded_pairs.hpp), which nodes alone would get wrong.

#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Task 3. Nodes apply body force and damping to all their mass. A folded pair has brought them mass of a mirror image, and on an image the
/// body force acts with the sign of its normal component changed. An image also needs the force that lets it follow a face which speeds up.
/// Adds what is missing to the block's tiles.
/// \param body_force  m/s2  \param damping  1/s
template <int Dim, class Shape>
void project_mirrored_forces(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block,
                             NodalVector<Dim>* tiles);

/// After Task 4. The reaction of a plane or a face is the rate at which it changes the momentum of the particles (docs/theory/step.md,
/// symmetry planes). impose_forces() has booked the part of the nodes on it; this function books the part of the folded pairs. Nodes
/// computed the work of body force and damping as if none of their mass were that of an image; this function corrects it.
/// \param load_values  per load and component
template <int Dim, class Shape>
void account_mirrored_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
