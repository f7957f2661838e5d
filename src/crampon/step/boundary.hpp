#pragma once
/// Nodal velocity conditions, consistent in momentum and force (N13 sec. 2.3-2.7; docs/theory/step.md, boundary values;
/// conventions 26-31), and symmetry planes.
///
/// A value belongs to the time of the momentum it is given to: the start of the step in Task 2, its end in Tasks 3 to 6.

#include <algorithm>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Values of all fixed components at the start and the end of the step; serial, as expressions are evaluated here.
template <int Dim>
void evaluate_conditions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// In the order that the functions here rely on: by node and axis, and for one component as stated.
inline void sort_by_component(std::vector<FixedComponent>& fixed) {
  std::stable_sort(fixed.begin(), fixed.end(), [](const FixedComponent& a, const FixedComponent& b) {
    return std::pair{a.node, a.axis} < std::pair{b.node, b.axis};
  });
}

/// Distance, m, from the shape of a prescribing rigid body within which nodes take its velocity: its faces are held at the row of nodes that
/// is nearest to them.
template <int Dim>
double prescribing_reach(const Grid<Dim>& grid) {
  return (0.5 + 1e-9) * grid.smallest_cell();
}

/// The nodes of a block that are in the shapes of prescribing rigid bodies at the start of the step, and the velocities of the bodies there.
template <int Dim>
void prescribe_by_rigid(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// After the step: which components they were. Serial.
template <int Dim>
void remember_rigid_conditions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Takes all momentum from prescribed components, in the terms of a series for velocities (step/filter_velocities.hpp). Own nodes of one block.
template <int Dim>
void clear_fixed_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Takes the normal momentum from nodes on symmetry planes, where mirror images meet. Own nodes of one block.
template <int Dim>
void impose_symmetry(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 2: keeps p_int and gives fixed components the prescribed momentum at the start of the step. Own nodes of one block.
template <int Dim>
void impose_start_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 3: the force on fixed components; books reactions. Restores p_int where the rule asks for it (conventions 27).
template <int Dim>
void impose_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 6: the prescribed momentum at the end of the step.
template <int Dim>
void impose_end_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Bit k: component k of this own node is fixed in this step.
template <int Dim>
unsigned fixed_axes(const StepWork<Dim>& work, std::size_t block, int node);

}  // namespace crampon
