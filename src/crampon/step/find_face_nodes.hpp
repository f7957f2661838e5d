#pragma once
/// Which nodes of deformable bodies meet the faces of rigid ones (docs/theory/contact.md, rigid faces).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// After find_contacts: what moves as one at the own nodes of a block, its parts of faces, and the particles before these.
template <int Dim, class Shape>
void find_face_nodes(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

}  // namespace crampon
