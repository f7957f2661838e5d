#pragma once
/// Components of nodal velocities that conditions fix, consistent in momentum and force (N13 sec. 2.3-2.7; docs/theory/step.md, boundary values;
/// conventions 26-31), and symmetry planes.
///
/// A value belongs to the time of the momentum it is given to: the start of the step in Task 2, its end in Tasks 3 to 6.

#include <algorithm>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Puts components in the order that for_fixed() and fixed_axes() rely on: by node and axis, and for one component as stated.
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

inline bool same_component(const FixedComponent& a, const FixedComponent& b) { return a.node == b.node && a.axis == b.axis; }

/// Of several active conditions on one component the last one stated holds.
inline bool is_overruled(const std::vector<FixedComponent>& fixed, std::size_t i) {
  for (std::size_t j = i + 1; j < fixed.size() && same_component(fixed[i], fixed[j]); ++j) {
    if (fixed[j].active) return true;
  }
  return false;
}

/// f(component, slot index into nodal arrays, index into p_int) for the active fixed components of a block, in all its layers.
template <int Dim, class F>
[[gnu::always_inline]] inline void for_fixed(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, F f) {
  auto& scratch = work.scratch[b];
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  const std::size_t count = scratch.fixed.size();
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    if (model.is_rigid(layers.node[l].field)) continue;
    for (std::size_t i = 0; i < count; ++i) {
      FixedComponent& c = scratch.fixed[i];
      if (!c.active) continue;
      if (is_overruled(scratch.fixed, i)) continue;
      f(c, layers.slot(l, c.node), l * count + i);
    }
  }
}

/// Bit k: component k of this own node is fixed in this step.
template <int Dim>
unsigned fixed_axes(const StepWork<Dim>& work, std::size_t block, int node);

}  // namespace crampon
