#include "crampon/step/held_nodes.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

namespace {

/// Prescribed in this step, by a condition that a mirror image can follow: not by a symmetry plane, which folds by itself; and not for the
/// first time, while the body still has a velocity of its own there.
template <int Dim>
bool holds(const Model<Dim>& model, const FixedComponent& c) {
  const VelocityCondition<Dim>& condition = model.conditions[c.condition];
  if (!c.active || condition.symmetry) return false;
  return !(c.newly_prescribed && model.fixed_force == FixedForce::incremental);
}

}  // namespace

template <int Dim, class Shape>
HeldNodes<Dim, Shape>::HeldNodes(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block) {
  if (!sees_beyond_faces<Shape>) return;
  const Block<Dim>& own = work.blocks.list[block];
  first_ = own.first_node();
  for (std::size_t k = 0; k < Dim; ++k) first_[k] -= T::offset;
  for (int o = 0; o < neighbour_count<Dim>; ++o) {
    const std::uint32_t there = own.neighbours[o];
    if (there == no_block) continue;
    for (const FixedComponent& c : work.scratch[there].fixed) {
      if (!holds(model, c)) continue;
      const int node = tile_node(work.blocks.list[there].node(c.node));
      if (node < 0) continue;
      components_.push_back({node, c.axis, c.condition, c.v_old, c.v_new});
    }
  }
  if (components_.empty()) return;
  // Of several on one component the last stated holds.
  const auto place = [](const Component& c) { return std::pair{c.node, c.axis}; };
  std::stable_sort(components_.begin(), components_.end(), [&](const Component& a, const Component& b) { return place(a) < place(b); });
  const auto last =
      std::unique(components_.rbegin(), components_.rend(), [&](const Component& a, const Component& b) { return place(a) == place(b); });
  components_.erase(components_.begin(), last.base());
  axes_.assign(T::nodes, 0);
  near_.assign(T::nodes, 0);
  for (const Component& c : components_) {
    std::uint8_t& axes = axes_[static_cast<std::size_t>(c.node)];
    axes = static_cast<std::uint8_t>(axes | 1u << c.axis);
    if (axes != 1u << c.axis) continue;  // once for a node
    // Stencils of the cells from this many before the node to one less after it may hold it.
    constexpr int before = cells_beyond<Shape> + 1;
    const IndexVector<Dim> node = unflatten<Dim>(c.node, T::side);
    for (int n = 0; n < power(2 * before, Dim); ++n) {
      IndexVector<Dim> cell = unflatten<Dim>(n, 2 * before);
      for (std::size_t k = 0; k < Dim; ++k) cell[k] += node[k] - before + first_[k];
      const int at = tile_node(cell);
      if (at >= 0) near_[static_cast<std::size_t>(at)] = 1;
    }
  }
}

template <int Dim, class Shape>
bool HeldNodes<Dim, Shape>::near_cell(const IndexVector<Dim>& cell) const {
  const int at = tile_node(cell);
  return at >= 0 && near_[static_cast<std::size_t>(at)] != 0;
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template class HeldNodes<DIM, SHAPE>;
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
