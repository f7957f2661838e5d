#include "crampon/step/crack_tractions.hpp"

#include <cmath>

#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/move_cracks.hpp"
#include "crampon/step/point_fields.hpp"

namespace crampon {

namespace {

/// What a force on a surface point moves: with a share w of it for each node, 1/sum(w^2/m), kg.
double moved_mass(const StepWork<2>& work, const std::vector<NodeOfPoint>& nodes) {
  double sum = 0;
  for (const NodeOfPoint& on : nodes) sum += on.weight * on.weight / work.nodes.momentum[on.slot][2];
  return 1 / sum;
}

/// Gives a force on a surface point to the nodes that move it.
void share_force(StepWork<2>& work, const std::vector<NodeOfPoint>& nodes, const Vec<2>& f) {
  for (const NodeOfPoint& on : nodes) {
    Vec<2> share = f * on.weight;
    for (int k = 0; k < 2; ++k) {
      if (on.flip >> k & 1u) share[k] = -share[k];
    }
    work.scratch[on.block].tractions.push_back({on.slot, share});
  }
}

}  // namespace

template <>
void start_tractions<2>(State<2>& state, const Model<2>& model) {
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    CrackTractionState<2>& t = state.cracks.list[c].traction;
    const std::size_t n = crack.plane.size();
    if (!model.tractions[c].acts()) continue;
    t.history.assign(n, {});
    t.force.assign(n, Vec<2>{});
    t.stored.assign(n, 0);
    t.between.assign(n, false);
  }
}

template <int Dim, class Shape>
StiffestVertex spread_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  StiffestVertex stiffest;
  if constexpr (Dim == 2) {
    for (auto& scratch : work.scratch) scratch.tractions.clear();
    const double cell = std::fmax(model.grid.cell[0], model.grid.cell[1]);
    std::vector<NodeOfPoint> above, below;
    for (std::size_t c = 0; c < state.cracks.size(); ++c) {
      const Crack<2>& crack = state.cracks.list[c];
      CrackTractionState<2>& t = state.cracks.list[c].traction;
      const std::vector<double>& area = model.tractions[c].area;
      const double stiffness = model.tractions[c].law->largest_stiffness();
      for (std::size_t v = 0; v < area.size(); ++v) {
        if (area[v] == 0 || t.history[v].failed != 0) continue;
        t.between[v] = !crack.upper_carriers[v].empty() && !crack.lower_carriers[v].empty();
        if (!t.between[v]) continue;  // a side without material bears nothing, and neither does the other then
        find_nodes_of_point<Shape>(state, work, model, crack.upper_carriers[v], above);
        find_nodes_of_point<Shape>(state, work, model, crack.lower_carriers[v], below);
        share_force(work, above, t.force[v]);
        share_force(work, below, -t.force[v]);
        if (!(stiffness > 0)) continue;
        // The nodes about a vertex bear the springs of a whole cell of crack (docs/theory/traction.md, time step).
        const double m_a = moved_mass(work, above), m_b = moved_mass(work, below);
        const double spring = stiffness * std::fmax(area[v], cell * model.tractions[c].thickness);
        const double longest = std::sqrt(m_a * m_b / ((m_a + m_b) * spring));
        if (longest < stiffest.time_step) stiffest = {longest, c, v};
      }
    }
    state.clock.traction_time_step = stiffest.time_step;
    state.clock.least_traction_time_step = std::fmin(state.clock.least_traction_time_step, state.clock.traction_time_step);
  }
  return stiffest;
}

template <int Dim, class Shape>
void share_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  spread_tractions<Dim, Shape>(state, work, model);
}

template <int Dim>
void add_tractions(StepWork<Dim>& work, std::size_t b) {
  for (const NodalForce<Dim>& load : work.scratch[b].tractions) {
    for (int k = 0; k < Dim; ++k) work.nodes.force[load.slot][k] += load.force[k];
  }
}

template <>
void update_tractions<2>(State<2>& state, StepWork<2>& work, const Model<2>& model) {
  const double end = state.clock.time + work.now.dt;
  if (!model.any_tractions()) return;
  CohesiveTotals& totals = state.ledger.cohesive;
  totals = {};
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    const CrackTraction& traction = model.tractions[c];
    CrackTractionState<2>& t = state.cracks.list[c].traction;
    const std::vector<double>& area = traction.area;
    const bool from_outside = traction.law->from_outside();
    for (std::size_t v = 0; v < area.size(); ++v) {
      if (area[v] == 0) continue;
      TractionHistory& history = t.history[v];
      if (history.failed == 0 && t.between[v]) {
        const CrackOpening opening = opening_at(crack, v);
        const Vec<3> place{{crack.plane[v][0], crack.plane[v][1], 0}};
        const Traction now = update_traction(*traction.law, {opening.opening, opening.sliding}, end + state.particles.lead, place, history);
        const Vec<2> down = vertex_normal(crack, v), tangent{{-down[1], down[0]}};
        t.force[v] = (down * now.normal - tangent * now.shear) * area[v];
        t.stored[v] = now.stored;
        if (history.failed != 0) {
          state.ledger.failures.push_back(
              {end, c, present_crack(state, work, crack).plane[v], history.dissipated_normal, history.dissipated_shear});
          t.force[v] = {};
          t.stored[v] = 0;
        }
      }
      totals.stored += area[v] * t.stored[v];
      totals.dissipated_normal += area[v] * history.dissipated_normal;
      totals.dissipated_shear += area[v] * history.dissipated_shear;
      if (from_outside) totals.work_of_pressure -= area[v] * (history.work_normal + history.work_shear);
    }
  }
}

// The input admits cracks in 2D only.
template <>
void start_tractions<3>(State<3>&, const Model<3>&) {}
template <>
void update_tractions<3>(State<3>&, StepWork<3>&, const Model<3>&) {}
template void add_tractions<2>(StepWork<2>&, std::size_t);
template void add_tractions<3>(StepWork<3>&, std::size_t);
#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                 \
  template StiffestVertex spread_tractions<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&); \
  template void share_tractions<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
