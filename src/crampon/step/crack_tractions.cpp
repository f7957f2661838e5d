#include "crampon/step/crack_tractions.hpp"

#include <cmath>

#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

namespace {

/// What a force on a surface point moves: with a share w of it for each node, 1/sum(w^2/m), kg.
template <int Dim>
double moved_mass(const StepWork<Dim>& work, const std::vector<NodeOfPoint>& nodes) {
  double sum = 0;
  for (const NodeOfPoint& on : nodes) sum += on.weight * on.weight / work.nodes.momentum[on.slot][Dim];
  return 1 / sum;
}

/// Gives a force on a surface point to the nodes that move it.
template <int Dim>
void share_force(StepWork<Dim>& work, const std::vector<NodeOfPoint>& nodes, const Vec<Dim>& f) {
  for (const NodeOfPoint& on : nodes) {
    Vec<Dim> share = f * on.weight;
    for (int k = 0; k < Dim; ++k) {
      if (on.flip >> k & 1u) share[k] = -share[k];
    }
    work.scratch[on.block].tractions.push_back({on.slot, share});
  }
}

/// The most of a crack along the axes of the grid that goes through one cell, m2.
template <int Dim>
double area_through_cell(const Grid<Dim>& grid, double thickness) {
  if constexpr (Dim == 2) {
    return grid.largest_cell() * thickness;
  } else {
    return grid.cell[0] * grid.cell[1] * grid.cell[2] / grid.smallest_cell();
  }
}

}  // namespace

template <int Dim>
void start_tractions(State<Dim>& state, const Model<Dim>& model) {
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<Dim>& crack = state.cracks.list[c];
    CrackTractionState<Dim>& t = state.cracks.list[c].traction;
    const std::size_t n = crack.plane.size();
    if (!model.tractions[c].acts()) continue;
    t.history.assign(n, {});
    t.force.assign(n, Vec<Dim>{});
    t.stored.assign(n, 0);
    t.between.assign(n, false);
  }
}

template <int Dim, class Shape>
StiffestVertex spread_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  StiffestVertex stiffest;
  for (auto& scratch : work.scratch) scratch.tractions.clear();
  std::vector<NodeOfPoint> above, below;
  const auto share = [&](const Crack<Dim>& crack, std::size_t v, const Vec<Dim>& on_upper) {
    find_nodes_of_point<Dim, Shape>(state, work, model, crack.upper_carriers[v], above);
    find_nodes_of_point<Dim, Shape>(state, work, model, crack.lower_carriers[v], below);
    share_force(work, above, on_upper);
    share_force(work, below, -on_upper);
  };
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<Dim>& crack = state.cracks.list[c];
    CrackTractionState<Dim>& t = state.cracks.list[c].traction;
    const std::vector<double>& area = t.area;
    const double stiffness = model.tractions[c].law->largest_stiffness();
    const double area_of_cell = area_through_cell(model.grid, model.tractions[c].thickness);
    for (std::size_t v = 0; v < area.size(); ++v) {
      if (area[v] == 0 || t.history[v].failed != 0) continue;
      t.between[v] = !crack.upper_carriers[v].empty() && !crack.lower_carriers[v].empty();
      if (!t.between[v]) continue;  // a side without material bears nothing, and neither does the other then
      share(crack, v, t.force[v]);
      if (!(stiffness > 0)) continue;
      // The nodes about a vertex bear the springs of a whole cell of crack (docs/theory/traction.md, time step).
      const double m_a = moved_mass(work, above), m_b = moved_mass(work, below);
      const double spring = stiffness * std::fmax(area[v], area_of_cell);
      const double longest = std::sqrt(m_a * m_b / ((m_a + m_b) * spring));
      if (longest < stiffest.time_step) stiffest = {longest, c, v};
    }
  }
  for (const Crack<Dim>& crack : state.cracks.list) {
    for (const FadingTraction<Dim>& f : crack.fading) {
      if (crack.upper_carriers[f.vertex].empty() || crack.lower_carriers[f.vertex].empty()) continue;
      share(crack, f.vertex, f.force);
    }
  }
  state.clock.traction_time_step = stiffest.time_step;
  state.clock.least_traction_time_step = std::fmin(state.clock.least_traction_time_step, state.clock.traction_time_step);
  return stiffest;
}

template void start_tractions<2>(State<2>&, const Model<2>&);
template void start_tractions<3>(State<3>&, const Model<3>&);
#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template StiffestVertex spread_tractions<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
