#include "crampon/step/verbs.hpp"

#include "crampon/step/rotation_sums.hpp"

namespace crampon {

template <int Dim>
void sum_rotation_of_motion(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  sum_read_rotation(state, work, model, b, ReadVelocity::motion);
}

template void sum_rotation_of_motion<2>(State<2>&, StepWork<2>&, const Model<2>&, std::size_t);
template void sum_rotation_of_motion<3>(State<3>&, StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
