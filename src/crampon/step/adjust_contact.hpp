#pragma once
/// Contact between velocity fields at the own nodes of a block (N03 section 2.2, N13 section 3; docs/theory/contact.md, the scheme).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Tasks 2 and 6 change momenta alone; Task 4 changes momenta and forces together and leaves fixed components alone. Nodes that meet_faces has
/// solved together with rigid faces take what it found.
template <int Dim>
void adjust_contact(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, ContactTask task);

}  // namespace crampon
