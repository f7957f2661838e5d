#include "crampon/step/verbs.hpp"

#include "crampon/step/fixed_components.hpp"

namespace crampon {

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

template void impose_forces<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void impose_forces<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
