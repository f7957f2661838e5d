#pragma once
/// Contact of bodies with the faces of rigid ones (docs/theory/contact.md, rigid faces), together with the pairs of the nodes there.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Before contact of a task at the nodes of a block: velocities of what meets faces; in Task 4, room for what contact is to remember.
template <int Dim>
void start_meeting_faces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, ContactTask task);

/// Impulses of all columns, and of the pairs of their nodes.
template <int Dim>
void meet_faces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, ContactTask task);

/// Gives the impulses to the nodes of a block: momentum, in Task 4 momentum and force; books energy and reactions.
template <int Dim>
void take_face_impulses(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, ContactTask task);

}  // namespace crampon
