#pragma once
/// Contact between velocity fields at the own nodes of a block (N03 section 2.2, N13 section 3, contact-consistency.md).

#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// After Task 1: finds the nodes with several fields, their groups, pairs, normals, gaps and volumes, which hold for the whole step.
template <int Dim>
void find_contacts(State<Dim>& state, const Model<Dim>& model, std::size_t block);

/// Tasks 2 and 6 change momenta alone; Task 4 changes momenta and forces together and leaves fixed components alone.
template <int Dim>
void adjust_contact(State<Dim>& state, const Model<Dim>& model, std::size_t block, ContactTask task, double dt);

/// After Task 6: what the next step must know about every contact. Serial.
template <int Dim>
void remember_contacts(State<Dim>& state);

}  // namespace crampon
