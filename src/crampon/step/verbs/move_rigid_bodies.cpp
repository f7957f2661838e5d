#include "crampon/step/verbs.hpp"

#include "crampon/step/rigid_motion.hpp"

namespace crampon {

template <int Dim>
void move_rigid_bodies(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  start_rigid_motion(state, model, work.now.dt);
}

template void move_rigid_bodies<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void move_rigid_bodies<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
