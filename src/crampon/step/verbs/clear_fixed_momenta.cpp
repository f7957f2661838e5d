#include "crampon/step/verbs.hpp"

#include "crampon/step/fixed_components.hpp"

namespace crampon {

template <int Dim>
void clear_fixed_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  for_fixed(work, model, b, [&](FixedComponent& c, std::size_t i, std::size_t) { work.nodes.momentum[i][c.axis] = 0; });
}

template void clear_fixed_momenta<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void clear_fixed_momenta<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
