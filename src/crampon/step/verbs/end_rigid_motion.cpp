#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void end_rigid_motion(State<Dim>& state) {
  for (RigidMotion<Dim>& motion : state.rigid) {
    motion.start = motion.end;
    motion.present = motion.present_end;
  }
}

template void end_rigid_motion<2>(State<2>&);
template void end_rigid_motion<3>(State<3>&);

}  // namespace crampon
