#pragma once
/// Momenta that carry the rotation of bodies (docs/decisions/0020-rotation.md). The velocity of a node is
///
///     v_i = (1/m_i) sum_p S_ip m_p (v_p + w x (x_i - x_p)),
///
/// with w the spin of the piece of p, of all its particles as if they were rigid: a body that only turns has v_i = w x x_i and no strain. w x arm_i,
/// arm_i = sum_p S_ip m_p (x_i - x_p), is what N03 Eq. 26 does not have. It does work on nodal forces; particles take that up as a rigid
/// rotation of the acceleration J^-1 sum_i arm_i x a_i beside sum S a, so that energy and angular momentum are kept.

#include "crampon/state/rotation.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Adds w x arm + s w x (w x arm) to the momenta of a block's nodes: velocities of a time that is ahead of the positions by s. Tasks 1, 6, and terms
/// of a series.
template <int Dim>
void carry_rotation(State<Dim>& state, StepWork<Dim>& work, std::size_t b, Spin PieceRotation<Dim>::*spin, double ahead);

/// Gives the particles of a block what answers the couples. Task 5, before what they take from nodes.
template <int Dim>
void take_up_couples(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, double dt);

}  // namespace crampon
