#include "crampon/step/boundary.hpp"

#include <algorithm>

#include "crampon/step/rigid_faces.hpp"

namespace crampon {

namespace {

template <int Dim>
Vec<3> node_place(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, int node) {
  const Vec<Dim> at = model.grid.node_position(work.blocks.list[block].node(node));
  Vec<3> x;
  for (int k = 0; k < Dim; ++k) x[k] = at[k];
  return x;
}

bool same_component(const FixedComponent& a, const FixedComponent& b) { return a.node == b.node && a.axis == b.axis; }

/// Of several active conditions on one component the last one stated holds.
bool is_overruled(const std::vector<FixedComponent>& fixed, std::size_t i) {
  for (std::size_t j = i + 1; j < fixed.size() && same_component(fixed[i], fixed[j]); ++j) {
    if (fixed[j].active) return true;
  }
  return false;
}

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

/// f(component, slot index into nodal arrays, index into p_int) for the active fixed components of a block, in all its layers.
template <int Dim, class F>
void for_fixed(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, F f) {
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

}  // namespace

template <int Dim>
void evaluate_conditions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const double dt = work.now.dt;
  const double t_old = state.clock.time, t_new = state.clock.time + dt;
  struct Value {
    bool active = false, everywhere = false;
    double v_old = 0, v_new = 0;
  };
  std::vector<std::vector<Value>> values(model.conditions.size());
  state.conditions.was_active.resize(model.conditions.size(), false);
  const std::vector<bool> was_active = state.conditions.was_active;
  for (std::size_t c = 0; c < model.conditions.size(); ++c) {
    const auto& condition = model.conditions[c];
    // A step belongs to the condition when it starts within its time.
    const bool active = t_old >= condition.start - 1e-9 * dt && t_old < condition.end - 1e-9 * dt;
    for (const auto& component : condition.components) {
      Value v{active, !component.value.depends_on_position(), 0, 0};
      if (v.everywhere && active) v.v_old = component.value(t_old, {}), v.v_new = component.value(t_new, {});
      values[c].push_back(v);
    }
    state.conditions.was_active[c] = active;
  }
  for (std::size_t b = 0; b < work.blocks.size(); ++b) {
    auto& fixed = work.scratch[b].fixed;
    bool was_prescribed = false;
    const FixedComponent* before = nullptr;  // by which it was prescribed in the last step: the last stated of those active
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      FixedComponent& f = fixed[i];
      if (i == 0 || !same_component(fixed[i - 1], f)) {  // the first of those on this component: was any of them active?
        before = nullptr;
        for (std::size_t j = i; j < fixed.size() && same_component(fixed[j], f); ++j) {
          if (was_active[fixed[j].condition]) before = &fixed[j];
        }
        was_prescribed = before != nullptr;
      }
      const Value& v = values[f.condition][f.component];
      f.active = v.active;
      f.newly_prescribed = v.active && !was_prescribed;
      f.v_old = v.v_old;
      f.v_new = v.v_new;
      if (v.active && !v.everywhere) {
        const ValueFunction& value = model.conditions[f.condition].components[f.component].value;
        const Vec<3> x = node_place(work, model, b, f.node);
        f.v_old = value(t_old, x);
        f.v_new = value(t_new, x);
      }
      // The velocity that the nodes have, where another condition gave it.
      if (v.active && before && before->condition != f.condition && model.conditions[before->condition].rigid_body < 0) {
        f.v_old = model.conditions[before->condition].components[before->component].value(t_old, node_place(work, model, b, f.node));
      }
    }
  }
}

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

template <int Dim>
void clear_fixed_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  for_fixed(work, model, b, [&](FixedComponent& c, std::size_t i, std::size_t) { work.nodes.momentum[i][c.axis] = 0; });
}

template <int Dim>
void impose_symmetry(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (model.symmetries.empty()) return;
  for_fixed(work, model, b, [&](FixedComponent& c, std::size_t i, std::size_t) {
    if (model.conditions[c.condition].symmetry) work.nodes.momentum[i][c.axis] = 0;
  });
}

template <int Dim>
void impose_start_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  auto& scratch = work.scratch[b];
  if (scratch.fixed.empty()) return;
  scratch.p_int.assign(scratch.fixed.size() * work.nodes.layers[b].node.size(), 0.);
  for_fixed(work, model, b, [&](FixedComponent& c, std::size_t i, std::size_t kept) {
    Pack& p = work.nodes.momentum[i];
    scratch.p_int[kept] = p[c.axis];
    const bool symmetry = model.conditions[c.condition].symmetry;
    // A component prescribed for the first time starts from what the body does (docs/theory/step.md, boundary values).
    if (!symmetry && c.newly_prescribed && model.fixed_force == FixedForce::incremental) return;
    p[c.axis] = symmetry ? 0. : p[Dim] * c.v_old;
  });
}

template <int Dim>
void impose_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const double dt = work.now.dt;
  auto& scratch = work.scratch[b];
  for_fixed(work, model, b, [&](FixedComponent& c, std::size_t i, std::size_t kept) {
    Pack& p = work.nodes.momentum[i];
    NodalVector<Dim>& f = work.nodes.force[i];
    const bool symmetry = model.conditions[c.condition].symmetry;
    const double free = f[c.axis];
    double fixed = 0;
    if (!symmetry) {
      switch (model.fixed_force) {
        case FixedForce::incremental:
          fixed = (p[Dim] * c.v_new - p[c.axis]) / dt;  // p is m V_old, or p_int in the first step
          break;
        case FixedForce::n13:
          fixed = (p[Dim] * c.v_new - scratch.p_int[kept]) / dt;  // N13 Eq. 1
          p[c.axis] = scratch.p_int[kept];                        // the p_k of N13 Eq. 2
          break;
        case FixedForce::zero:
          break;  // N03 Task 3
      }
    }
    f[c.axis] = fixed;
    const double reaction = fixed - free;
    scratch.ledger.add_reaction(c.condition, c.axis, reaction);
    if (symmetry) return;
    scratch.ledger.boundary_work += reaction * 0.5 * (c.v_old + c.v_new) * dt;
    // A sudden start is an inelastic impact: what the condition gives and the body does not get.
    if (c.newly_prescribed && model.fixed_force == FixedForce::incremental && p[Dim] > 0)
      scratch.ledger.contact_loss += reaction * 0.5 * (c.v_old - p[c.axis] / p[Dim]) * dt;
  });
}

template <int Dim>
void impose_end_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (work.scratch[b].fixed.empty()) return;
  for_fixed(work, model, b, [&](FixedComponent& c, std::size_t i, std::size_t) {
    Pack& p = work.nodes.momentum[i];
    p[c.axis] = model.conditions[c.condition].symmetry ? 0. : p[Dim] * c.v_new;
  });
}

template <int Dim>
unsigned fixed_axes(const StepWork<Dim>& work, std::size_t b, int node) {
  unsigned axes = 0;
  const auto& fixed = work.scratch[b].fixed;
  auto at = std::lower_bound(fixed.begin(), fixed.end(), node, [](const FixedComponent& c, int n) { return c.node < n; });
  for (; at != fixed.end() && at->node == node; ++at) {
    if (at->active) axes |= 1u << at->axis;
  }
  return axes;
}

#define CRAMPON_INSTANTIATE(DIM)                                                                      \
  template void evaluate_conditions<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);             \
  template void prescribe_by_rigid<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t); \
  template void remember_rigid_conditions<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);       \
  template void clear_fixed_momenta<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);             \
  template void impose_symmetry<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);                 \
  template void impose_start_momenta<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);            \
  template void impose_forces<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);                   \
  template void impose_end_momenta<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);              \
  template unsigned fixed_axes<DIM>(const StepWork<DIM>&, std::size_t, int);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
