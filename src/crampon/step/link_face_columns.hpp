#pragma once
/// In what columns nodes meet the faces of rigid bodies, with what normal and gap (docs/theory/contact.md, rigid faces).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Gathers the parts that find_face_nodes has found in all blocks in columns, and columns that share nodes in sets. Serial.
template <int Dim>
void link_face_columns(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
