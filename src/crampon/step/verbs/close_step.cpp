#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void close_step(State<Dim>& state, StepWork<Dim>& work) {
  state.clock.time += work.now.dt;
  ++state.clock.step;
}

template void close_step<2>(State<2>&, StepWork<2>&);
template void close_step<3>(State<3>&, StepWork<3>&);

}  // namespace crampon
