#include "crampon/step/verbs.hpp"

#include <algorithm>

#include "crampon/step/fixed_components.hpp"
#include "crampon/step/rigid_faces.hpp"

namespace crampon {

namespace {

template <int Dim>
Vec<Dim> middle_of_block(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const auto& block = work.blocks.list[b];
  return 0.5 * (model.grid.node_position(block.node(0)) + model.grid.node_position(block.node(block_nodes<Dim> - 1)));
}

template <int Dim>
double half_diagonal_of_block(const Grid<Dim>& grid) {
  Vec<Dim> side;
  for (std::size_t k = 0; k < Dim; ++k) side[k] = block_side * grid.cell[k];
  return 0.5 * norm(side);
}

}  // namespace

template <int Dim>
void prescribe_by_rigid(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  auto& fixed = work.scratch[b].fixed;
  const auto by_rigid = [&](const FixedComponent& f) { return model.conditions[f.condition].rigid_body >= 0; };
  fixed.erase(std::remove_if(fixed.begin(), fixed.end(), by_rigid), fixed.end());
  const double reach = prescribing_reach(model.grid);
  bool added = false;
  for (std::size_t r = 0; r < model.rigid_bodies.size(); ++r) {
    const RigidBody<Dim>& body = model.rigid_bodies[r];
    if (!body.prescribes()) continue;
    const RigidMotion<Dim>& motion = state.rigid[r];
    if (distance_from(body, motion.start, middle_of_block(work, model, b)) > reach + half_diagonal_of_block(model.grid)) continue;
    for (int node = 0; node < block_nodes<Dim>; ++node) {
      const IndexVector<Dim> index = work.blocks.list[b].node(node);
      const Vec<Dim> x = model.grid.node_position(index);
      if (!(distance_from(body, motion.start, x) <= reach)) continue;
      const Vec<Dim> v_old = motion.start.velocity_at(x), v_new = motion.end.velocity_at(x);
      const auto& components = model.conditions[body.condition].components;
      for (std::size_t q = 0; q < components.size(); ++q) {
        const int axis = components[q].axis;
        FixedComponent f;
        f.node = static_cast<std::uint16_t>(node);
        f.axis = static_cast<std::uint8_t>(axis);
        f.condition = body.condition;
        f.component = static_cast<std::uint16_t>(q);
        f.active = true;
        f.newly_prescribed = !std::binary_search(state.conditions.prescribed_by_rigid.begin(), state.conditions.prescribed_by_rigid.end(),
                                                 model.grid.node_number(index) * Dim + axis);
        f.v_old = v_old[axis];
        f.v_new = v_new[axis];
        fixed.push_back(f);
        added = true;
      }
    }
  }
  if (added) sort_by_component(fixed);
}

template void prescribe_by_rigid<2>(State<2>&, StepWork<2>&, const Model<2>&, std::size_t);
template void prescribe_by_rigid<3>(State<3>&, StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
