#pragma once
/// Forces, works and reactions of folded pairs (step/folded_pairs.hpp), which nodes alone would get wrong.

#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Task 3. Nodes add body force and damping to all their mass; on what folded pairs brought them these act as on a mirror image. An image
/// also takes the force that follows an accelerated face. Adds the difference to the block's tiles.
/// \param body_force  m/s2  \param damping  1/s
template <int Dim, class Shape>
void project_mirrored_forces(const State<Dim>& state, const Model<Dim>& model, std::size_t block, const Vec<Dim>& body_force,
                             double damping, NodalVector<Dim>* tiles);

/// After Task 4. Books the part of reactions that folded pairs carry, so that a plane's or a face's reaction is the rate at which it changes
/// the momentum of the particles (docs/theory/step.md, symmetry planes); impose_forces has booked that of the nodes on it. Corrects the
/// works that nodes took all their mass for.
/// \param load_values  per load and component
template <int Dim, class Shape>
void account_mirrored_forces(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt,
                             const std::vector<Vec<Dim>>& load_values, const Vec<Dim>& body_force, double damping);

}  // namespace crampon
