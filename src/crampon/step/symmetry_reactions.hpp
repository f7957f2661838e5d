#pragma once
/// What symmetry planes do to the momentum of the particles.

#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// After Task 4. Books the part of the planes' reactions that folded pairs carry, so that a plane's reaction is the rate at which it changes
/// the momentum of the particles (docs/theory/step.md, symmetry planes); impose_forces has booked that of the nodes on the planes.
/// \param load_values  per load and component  \param body_force  m/s2  \param damping  1/s
template <int Dim, class Shape>
void account_symmetry(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt, const std::vector<Vec<Dim>>& load_values,
                      const Vec<Dim>& body_force, double damping);

}  // namespace crampon
