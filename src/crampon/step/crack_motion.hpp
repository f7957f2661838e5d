#pragma once
/// Where the points of cracks go: surface points with their carriers, and vertices of the plane.

#include <optional>
#include <vector>

#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// How far the points of a crack move; none: nothing says it.
template <int Dim>
struct CrackMotion {
  std::vector<std::optional<Vec<Dim>>> upper, lower, plane;
};

/// That of the surfaces with their carriers, and of the plane with both of them.
template <int Dim>
CrackMotion<Dim> carried_motion(const State<Dim>& state, const StepWork<Dim>& work, const Crack<Dim>& crack, PositionTime time);

/// Moves the points. Vertices of the plane of which nothing says how far they move go with the nearest one of which something does, and surface
/// points with their vertex.
template <int Dim>
void move_points(CrackMotion<Dim> motion, Crack<Dim>& crack);

/// The last vertex of a closed crack is its first.
template <int Dim>
void close_ends(Crack<Dim>& crack);

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
