#pragma once
#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Task 8, after particles have moved. Surface points go with their carriers (step/crack_carriers.hpp). Vertices of the plane move with the
/// centre-of-mass velocity of all fields (N03 Eq. 32; conventions 39), v = sum S v_cm with linear S; where some of the nodes about have no
/// mass, with the mean of their surface points. The plane stays between its surfaces. Vertices without any of these go with the nearest
/// vertex of their crack that has one.
template <int Dim>
void move_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// After the positions of particles have been changed otherwise than by a step: surface points go with their carriers, and vertices of the plane
/// with both of them.
template <int Dim>
void carry_cracks(State<Dim>& state, StepWork<Dim>& work);

/// The crack with its points at the present time, which those that the step works with lead (docs/theory/step.md, time of positions): what all
/// ask for who look at the state from outside.
template <int Dim>
Crack<Dim> present_crack(const State<Dim>& state, const StepWork<Dim>& work, Crack<Dim> crack);

/// Opening and sliding of a vertex, m: the vector from the lower to the upper surface point, along the normal from below to above and along the
/// crack plane there. In the plane sliding has a sign: it is counted along the direction of the path. In space it is the length of the part along
/// the crack plane.
struct CrackOpening {
  double opening = 0, sliding = 0;
};
/// Of all vertices.
template <int Dim>
std::vector<CrackOpening> openings_of(const Crack<Dim>& crack);

/// What openings are measured along, at one vertex.
template <int Dim>
struct OpeningFrame {
  Vec<Dim> down;     ///< unit normal, from above to below
  Vec<Dim> tangent;  ///< unit vector along which sliding is counted; in space zero where there is none
  CrackOpening opening;

  OpeningFrame(const Crack<Dim>& crack, std::size_t vertex, const Vec<Dim>& normal) : down(normal) {
    const Vec<Dim> gap = crack.upper[vertex] - crack.lower[vertex];
    if constexpr (Dim == 2) {  // a plane has one tangent, so that both senses can be told apart
      tangent = Vec<2>{{-down[1], down[0]}};
    } else {
      tangent = normalized(gap - down * dot(gap, down));
    }
    opening = {-dot(gap, down), dot(gap, tangent)};
  }
};

}  // namespace crampon
