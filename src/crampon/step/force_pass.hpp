#pragma once
/// Forces of a block's particles on its tiles (N03 Eq. 28), after a stress update or alone.

#include "crampon/step/packs.hpp"

namespace crampon {

/// Internal forces of a pack (N03 Eq. 28) into tiles.
template <int Dim, class Shape>
auto internal_forces(const Particles<Dim>& particles, NodalVector<Dim>* tiles) {
  return [&particles, tiles](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run&) {
    scatter_force<Dim, Shape>(stencil, targets, particles.mass_volume[2 * std::size_t{pack} + 1],
                              &particles.stress[std::size_t{pack} * stress_size<Dim>], tiles);
  };
}

/// Adds the forces other than internal ones: of loads, of what keeps rigid bodies on their way, and of folded pairs.
template <int Dim, class Shape>
void project_other_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, NodalVector<Dim>* tiles);

}  // namespace crampon
