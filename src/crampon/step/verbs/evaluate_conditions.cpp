#include "crampon/step/verbs.hpp"

#include "crampon/step/fixed_components.hpp"

namespace crampon {

namespace {

template <int Dim>
Vec<3> node_place(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, int node) {
  const Vec<Dim> at = model.grid.node_position(work.blocks.list[block].node(node));
  Vec<3> x;
  for (int k = 0; k < Dim; ++k) x[k] = at[k];
  return x;
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

template void evaluate_conditions<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void evaluate_conditions<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
