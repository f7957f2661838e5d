#include "crampon/step/verbs.hpp"

#include "crampon/step/rotation_sums.hpp"

namespace crampon {

template <int Dim>
void answer_couples(State<Dim>& state, StepWork<Dim>& work) {
  const VelocityRule& rule = work.now.rule;
  const std::vector<RotationCouple> total = total_couples(state, work);
  for (std::size_t i = 0; i < total.size(); ++i) {
    PieceRotation<Dim>& rotation = work.rotations[i];
    const RotationCouple& sum = total[i];
    rotation.acceleration = rotation.rotation_of(sum.couple);
    rotation.spin_end = rotation.spin * (rule.own - rule.damped) + rotation.rotation_of(sum.read * rule.nodal + sum.torque * rule.gain) -
                        rotation.acceleration * (rule.damped * rule.dt);
  }
}

template void answer_couples<2>(State<2>&, StepWork<2>&);
template void answer_couples<3>(State<3>&, StepWork<3>&);

}  // namespace crampon
