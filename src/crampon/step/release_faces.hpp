#pragma once
/// The faces that a tip leaves behind as it grows come free little by little (docs/theory/fracture.md, release).

#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/tip_watch.hpp"

namespace crampon {

/// Lays the tractions that held the faces of the `added` last segments at a tip together on their vertices: the mean stress of particles within a cell. They fade until `until`, s.
void release_faces(State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch, std::size_t added, double until);

}  // namespace crampon
