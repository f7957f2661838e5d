#pragma once
#include <cstddef>
#include <span>

#include "crampon/crack/virtual_extension.hpp"

namespace crampon {

/// A piece of crack between two vertices, under tractions.
struct FaceTraction {
  double weight = 0;         ///< q in its middle
  Vec<2> traction;           ///< with which the faces hold each other, Pa: on the left side, against its opening
  Vec<2> opening_step;       ///< by which the opening (left side less right) grows towards the tip, m
  double near = 0, far = 0;  ///< distances of its ends from the tip, m
};

/// One side of a piece of crack: what the material along it holds.
struct CrackSideSample {
  Vec<2> place;           ///< of its middle, m
  Vec<2> normal;          ///< out of the material
  double length = 0;      ///< m
  bool is_left = true;    ///< of the crack, seen towards the tip
  std::size_t piece = 0;  ///< number of the piece, from the tip backwards
  Tensor2 stress{}, gradient{};
  double energy = 0;  ///< of stress work and motion, J/m3
  Vec<2> momentum;    ///< per volume, kg/(m2 s)
};

/// J of a tip, in its frame, J/m2: what goes into the tip if it moves on along the first axis, or along the second. As a sum over particles
/// (docs/theory/fracture.md, J as an integral over the domain):
///   J_1 = sum A { [P_iJ u_i,k - (W + K) delta_kJ] q_k,J + rho [a_i u_i,k - v_i v_i,k] q_k } + sum |q| T . d(opening),
/// with K the kinetic energy and q the virtual extension, which runs along the faces. Tractions of the faces take their part on the way. J_2 is the same with a shift to the left,
/// which does not run along them: sum l q (W + K) n_2 over both faces joins.
Vec<2> j_integral(std::span<const TipSample> samples, const VirtualExtension& extension, std::span<const FaceTraction> tractions,
                  std::span<const CrackSideSample> faces = {});

}  // namespace crampon
