#include "crampon/step/tip_samples.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void watch_tips(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  if constexpr (Dim == 2) work.tips = watch_particles(state, model);
}

template void watch_tips<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void watch_tips<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
