#include "crampon/step/verbs.hpp"

#include "crampon/step/rotation_sums.hpp"

namespace crampon {

template <int Dim>
void find_term_spins(State<Dim>& state, StepWork<Dim>& work) {
  const std::vector<RotationCouple> total = total_couples(state, work);
  for (std::size_t i = 0; i < total.size(); ++i) {
    work.rotations[i].spin_term = work.rotations[i].rotation_of(total[i].read);
  }
}

template void find_term_spins<2>(State<2>&, StepWork<2>&);
template void find_term_spins<3>(State<3>&, StepWork<3>&);

}  // namespace crampon
