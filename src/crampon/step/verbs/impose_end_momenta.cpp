#include "crampon/step/verbs.hpp"

#include "crampon/step/fixed_components.hpp"

namespace crampon {

template <int Dim>
void impose_end_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (work.scratch[b].fixed.empty()) return;
  for_fixed(work, model, b, [&](FixedComponent& c, std::size_t i, std::size_t) {
    Pack& p = work.nodes.momentum[i];
    p[c.axis] = model.conditions[c.condition].symmetry ? 0. : p[Dim] * c.v_new;
  });
}

template void impose_end_momenta<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void impose_end_momenta<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
