#pragma once
/// Particles that bear stress from the start.

#include "crampon/material/material_law.hpp"

namespace crampon {

/// Components of stress that may be chosen: xx, yy, xy in 2D (the law then knows zz); xx, yy, zz, xy, yz, xz in space.
template <int Dim>
inline constexpr int chosen_stress_size = Dim == 2 ? 3 : 6;

/// Finds the elastic strain without rotation under which four particles bear a given stress, by Newton's method on the law itself, and sets
/// their stress and history to it. Energies, volumes and strains then start from that state.
///   cauchy:  [chosen_stress_size<Dim>] Cauchy stress, Pa
///   stress:  [stress_size<Dim>], history: [law.history_size(Dim)]
/// False where the law has no such state, or only one that took plastic flow.
template <int Dim>
bool find_initial_state(const MaterialLaw& law, StressState, const Pack* cauchy, Pack* stress, Pack* history);

}  // namespace crampon
