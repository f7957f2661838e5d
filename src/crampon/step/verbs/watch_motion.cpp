#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void watch_motion(State<Dim>& state, StepWork<Dim>& work) {
  Particles<Dim>& particles = state.particles;
  particles.watched = work.now.watched && work.now.lead > 0;
  particles.moved_with.resize_discarding(particles.watched ? particles.size() : 0);
}

template void watch_motion<2>(State<2>&, StepWork<2>&);
template void watch_motion<3>(State<3>&, StepWork<3>&);

}  // namespace crampon
