#include "crampon/core/parallel.hpp"
#include "crampon/step/tip_samples.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void find_fracture_parameters(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  if constexpr (Dim == 2) {
    std::vector<CrackTip>& tips = state.fracture.tips;
    std::vector<CrackTip> found = tips;  // each sees where the others are
    parallel_for(tips.size(), model.threads,
                 [&](std::size_t t) { find_parameters(state, work, model, work.tips[t], work.now.dt, found[t]); });
    tips = std::move(found);
    while (state.fracture.next <= state.clock.time * (1 + 1e-12)) state.fracture.next += model.fracture.interval;
  }
}

template void find_fracture_parameters<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void find_fracture_parameters<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
