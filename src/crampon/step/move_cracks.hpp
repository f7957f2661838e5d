#pragma once
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Task 8, after particles have moved. Surface points go with their carriers (step/crack_carriers.hpp). Vertices of the plane move with the
/// centre-of-mass velocity of all fields (N03 Eq. 32; CONVENTIONS 39), v = sum S v_cm with linear S; where some of the nodes about have no
/// mass, with the mean of their surface points. The plane stays between its surfaces. Vertices without any of these go with the nearest
/// vertex of their crack that has one.
template <int Dim>
void move_cracks(State<Dim>& state, const Model<Dim>& model, double dt);

/// Opening and sliding of a vertex, m: the vector from the lower to the upper surface point along the upward normal and the tangent
/// of the crack plane there.
struct CrackOpening {
  double opening = 0, sliding = 0;
};
CrackOpening opening_at(const Crack<2>& crack, std::size_t vertex);

}  // namespace crampon
