#include "crampon/step/verbs.hpp"

#include "crampon/step/fixed_components.hpp"

namespace crampon {

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

template void impose_start_momenta<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void impose_start_momenta<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
