#pragma once
/// A crack gets longer at a tip, or starts.

#include <cstdint>
#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Adds vertices to the crack of a tip, in the order in which the tip comes by them, where they are now (m). Surface points near the tip choose new carriers; the traction law
/// of the crack acts on what is new where growth is bridged. reach: of view_cracks(). Nothing of particles and nodes is changed.
void extend_crack(State<2>& state, StepWork<2>& work, const Model<2>& model, const CrackTip& tip, const std::vector<Vec<2>>& places,
                  int reach);

/// Gives a crack that has not started its vertices, where they are now (m), from its start to its end; Crack::extension is set before. The traction law of the crack
/// acts on all of it. reach: of view_cracks(). Nothing of particles and nodes is changed.
void start_crack(State<2>& state, StepWork<2>& work, const Model<2>& model, std::uint32_t number, const std::vector<Vec<2>>& places,
                 int reach);

}  // namespace crampon
