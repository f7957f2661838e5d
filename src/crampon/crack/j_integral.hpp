#pragma once
#include <span>

#include "crampon/crack/tip_domain.hpp"

namespace crampon {

/// A piece of crack between two vertices, under tractions.
struct FaceTraction {
  double weight = 0;         ///< q in its middle
  Vec<2> traction;           ///< with which the faces hold each other, Pa: on the left side, against its opening
  Vec<2> opening_step;       ///< by which the opening (left side less right) grows towards the tip, m
  double near = 0, far = 0;  ///< distances of its ends from the tip, m
};

/// J of a tip, in its frame, J/m2: what goes into the tip if it moves on along the first axis, or along the second. As a sum over particles
/// (docs/theory/fracture.md, J as an integral over the domain):
///   J_k = sum A { [P_iJ u_i,k - (W + K) delta_kJ] q,J + rho [a_i u_i,k - v_i v_i,k] q } + sum q T . d(opening),
/// with K the kinetic energy. Tractions of the faces take their part on the way.
Vec<2> j_integral(std::span<const TipSample> samples, const TipWeight& weight, std::span<const FaceTraction> faces);

}  // namespace crampon
