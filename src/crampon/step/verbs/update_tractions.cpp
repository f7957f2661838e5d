#include "crampon/step/crack_motion.hpp"
#include "crampon/step/point_fields.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void update_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const double end = state.clock.time + work.now.dt;
  if (!model.any_tractions()) return;
  CohesiveTotals& totals = state.ledger.cohesive;
  totals = {};
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<Dim>& crack = state.cracks.list[c];
    const CrackTraction& traction = model.tractions[c];
    CrackTractionState<Dim>& t = state.cracks.list[c].traction;
    const std::vector<double>& area = t.area;
    const std::vector<Vec<Dim>> normals = traction.acts() ? vertex_normals(crack) : std::vector<Vec<Dim>>{};
    const bool from_outside = traction.law->from_outside();
    for (std::size_t v = 0; v < area.size(); ++v) {
      if (area[v] == 0) continue;
      TractionHistory& history = t.history[v];
      if (history.failed == 0 && t.between[v]) {
        const OpeningFrame<Dim> frame(crack, v, normals[v]);
        Vec<3> place;
        for (int k = 0; k < Dim; ++k) place[k] = crack.plane[v][k];
        const Traction now =
            update_traction(*traction.law, {frame.opening.opening, frame.opening.sliding}, end + state.particles.lead, place, history);
        t.force[v] = (frame.down * now.normal - frame.tangent * now.shear) * area[v];
        t.stored[v] = now.stored;
        if (history.failed != 0) {
          state.ledger.events.push_back(
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

template void update_tractions<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void update_tractions<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
