#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Task 8: vertices move with the centre-of-mass velocity of all fields (N03 Eq. 32; CONVENTIONS 39), v = sum S v_cm / sum S over nodes
/// with mass, linear S. Surface points go with the fields of their own side, in the same way (CrackSurfaces::nodes), and are taken back to the
/// plane where faces that can touch have drifted through it (docs/decisions/0005). Vertices that see no mass go with the nearest vertex of
/// their crack that does.
template <int Dim>
void move_cracks(State<Dim>& state, const Model<Dim>& model, double dt);

/// Opening and sliding of a vertex, m: the vector from the lower to the upper surface point along the upward normal and the tangent
/// of the crack plane there.
struct CrackOpening {
  double opening = 0, sliding = 0;
};
CrackOpening opening_at(const Crack<2>& crack, std::size_t vertex);

}  // namespace crampon
