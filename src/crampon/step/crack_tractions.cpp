#include "crampon/step/crack_tractions.hpp"

#include <cmath>
#include <limits>

#include "crampon/step/crack_surfaces.hpp"
#include "crampon/step/move_cracks.hpp"

namespace crampon {

namespace {

/// What a force on a surface point moves: with a share w of it for each node, 1/sum(w^2/m), kg; 0: nothing.
double moved_mass(const SurfaceNodes& nodes) {
  double sum = 0;
  for (const SurfaceNode& on : nodes) sum += on.weight * on.weight / on.p[2];
  return sum > 0 ? 1 / sum : 0.;
}

/// Shares f among the nodes, and among the materials there by mass.
void share_force(State<2>& state, const CrackSurfaces& surfaces, const SurfaceNodes& nodes, const Vec<2>& f) {
  for (const SurfaceNode& on : nodes) {
    surfaces.for_layers(on.node, on.side, [&](std::size_t slot) {
      state.scratch[on.node.block].tractions.push_back({slot, f * (on.weight * state.nodes.momentum[slot][2] / on.p[2])});
    });
  }
}

}  // namespace

template <>
void start_tractions<2>(State<2>& state, const Model<2>& model) {
  state.tractions.resize(state.cracks.size());
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    CrackTractionState<2>& t = state.tractions[c];
    const std::size_t n = crack.plane.size();
    if (!model.tractions[c].acts()) continue;
    t.history.assign(n, {});
    t.force.assign(n, Vec<2>{});
    t.stored.assign(n, 0);
    t.area.assign(n, 0);
    t.between.assign(n, false);
    // Segments between two vertices that bear the law, half to each.
    for (std::size_t v = 0; v + 1 < n; ++v) {
      if (!model.tractions[c].bears[v] || !model.tractions[c].bears[v + 1]) continue;
      const double half = 0.5 * norm(crack.original[v + 1] - crack.original[v]) * model.tractions[c].thickness;
      t.area[v] += half;
      t.area[v + 1] += half;
    }
  }
}

template <>
void spread_tractions<2>(State<2>& state, const Model<2>& model) {
  if (!model.any_tractions()) return;
  for (auto& scratch : state.scratch) scratch.tractions.clear();
  const CrackSurfaces surfaces(state, model);
  state.traction_time_step = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    CrackTractionState<2>& t = state.tractions[c];
    const double stiffness = largest_stiffness(model.tractions[c].law);
    for (std::size_t v = 0; v < t.area.size(); ++v) {
      if (t.area[v] == 0 || t.history[v].failed != 0) continue;
      const auto [above, below] = surfaces.faces(crack, v);
      t.between[v] = !above.empty() && !below.empty();
      if (!t.between[v]) continue;  // a side without mass bears nothing, and neither does the other then
      share_force(state, surfaces, above, t.force[v]);
      share_force(state, surfaces, below, -t.force[v]);
      if (!(stiffness > 0)) continue;
      // The nodes about a vertex bear the springs of a whole cell of crack (docs/theory/traction.md, time step).
      double cell = 0;
      for (int k = 0; k < 2; ++k) cell = std::fmax(cell, model.grid.cell[k]);
      const double m_a = moved_mass(above), m_b = moved_mass(below);
      const double spring = stiffness * std::fmax(t.area[v], cell * model.tractions[c].thickness);
      state.traction_time_step = std::fmin(state.traction_time_step, std::sqrt(m_a * m_b / ((m_a + m_b) * spring)));
    }
  }
  state.least_traction_time_step = std::fmin(state.least_traction_time_step, state.traction_time_step);
}

template <int Dim>
void add_tractions(State<Dim>& state, std::size_t b) {
  for (const NodalForce<Dim>& load : state.scratch[b].tractions) {
    for (int k = 0; k < Dim; ++k) state.nodes.force[load.slot][k] += load.force[k];
  }
}

template <>
void update_tractions<2>(State<2>& state, const Model<2>& model, double dt) {
  if (!model.any_tractions()) return;
  CohesiveTotals& totals = state.cohesive;
  totals = {};
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    const CrackTraction& traction = model.tractions[c];
    CrackTractionState<2>& t = state.tractions[c];
    const bool from_outside = std::holds_alternative<PressureTraction>(traction.law);
    for (std::size_t v = 0; v < t.area.size(); ++v) {
      if (t.area[v] == 0) continue;
      TractionHistory& history = t.history[v];
      if (history.failed == 0 && t.between[v]) {
        const CrackOpening opening = opening_at(crack, v);
        const Vec<3> place{{crack.plane[v][0], crack.plane[v][1], 0}};
        const Traction now = update_traction(traction.law, {opening.opening, opening.sliding}, state.time + dt, place, history);
        const Vec<2> down = vertex_normal(crack, v), tangent{{-down[1], down[0]}};
        t.force[v] = (down * now.normal - tangent * now.shear) * t.area[v];
        t.stored[v] = now.stored;
        if (history.failed != 0) {
          state.events.push_back({state.time + dt, c, crack.plane[v], history.dissipated_normal, history.dissipated_shear});
          t.force[v] = {};
          t.stored[v] = 0;
        }
      }
      totals.stored += t.area[v] * t.stored[v];
      totals.dissipated_normal += t.area[v] * history.dissipated_normal;
      totals.dissipated_shear += t.area[v] * history.dissipated_shear;
      if (from_outside) totals.work_of_pressure -= t.area[v] * (history.work_normal + history.work_shear);
    }
  }
}

// The input admits cracks in 2D only.
template <>
void start_tractions<3>(State<3>&, const Model<3>&) {}
template <>
void spread_tractions<3>(State<3>&, const Model<3>&) {}
template <>
void update_tractions<3>(State<3>&, const Model<3>&, double) {}
template void add_tractions<2>(State<2>&, std::size_t);
template void add_tractions<3>(State<3>&, std::size_t);

}  // namespace crampon
