#include "crampon/step/verbs.hpp"

#include "crampon/step/fixed_components.hpp"

namespace crampon {

template <int Dim>
void impose_symmetry(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (model.symmetries.empty()) return;
  for_fixed(work, model, b, [&](FixedComponent& c, std::size_t i, std::size_t) {
    if (model.conditions[c.condition].symmetry) work.nodes.momentum[i][c.axis] = 0;
  });
}

template void impose_symmetry<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void impose_symmetry<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
