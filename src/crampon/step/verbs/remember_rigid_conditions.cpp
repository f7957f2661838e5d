#include "crampon/step/verbs.hpp"

#include <algorithm>

namespace crampon {

template <int Dim>
void remember_rigid_conditions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  state.conditions.prescribed_by_rigid.clear();
  if (model.rigid_bodies.empty()) return;
  for (std::size_t b = 0; b < work.blocks.size(); ++b) {
    for (const FixedComponent& f : work.scratch[b].fixed) {
      if (model.conditions[f.condition].rigid_body < 0) continue;
      state.conditions.prescribed_by_rigid.push_back(model.grid.node_number(work.blocks.list[b].node(f.node)) * Dim + f.axis);
    }
  }
  std::sort(state.conditions.prescribed_by_rigid.begin(), state.conditions.prescribed_by_rigid.end());
}

template void remember_rigid_conditions<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void remember_rigid_conditions<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
