#pragma once
/// Surface points of cracks are points of the material: each is carried by some particles on its side of the crack, those about it at the
/// start. Its displacement is a weighted mean of theirs, exact for any linear field of displacements, and tractions reach the nodes by the
/// way back, through the same particles (docs/decisions/0010-surface-points.md).

#include <array>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Takes its carriers from a point that has lost one, since they no longer say where it is. After particles were removed.
template <int Dim>
void drop_lost_carriers(State<Dim>& state, StepWork<Dim>& work);

/// Where positions are taken: in the middle of the coming step, with which the step works, or at the present time.
enum class PositionTime { leading, present };

/// Displacement of a point since the start, m. It has carriers.
template <int Dim>
Vec<Dim> carried_displacement(const State<Dim>& state, const StepWork<Dim>& work, const std::vector<Carrier>& carriers, PositionTime time);

/// A part of what moves a surface point: the velocity of a node in one field, with component k reversed where bit k of flip is set.
struct NodeOfPoint {
  std::uint32_t block = 0;
  std::size_t slot = 0;  ///< in the nodal arrays
  std::uint8_t flip = 0;
  double weight = 0;
};

/// The nodes that carriers take their velocity from: a point moves with sum w v, and a force f on it gives them w f. None twice with the
/// same flip; in the order of discovery. Overwrites `nodes`.
template <int Dim, class Shape>
void find_nodes_of_point(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, const std::vector<Carrier>& carriers,
                         std::vector<NodeOfPoint>& nodes);

}  // namespace crampon
