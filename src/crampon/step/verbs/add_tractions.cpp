#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void add_tractions(StepWork<Dim>& work, std::size_t b) {
  for (const NodalForce<Dim>& load : work.scratch[b].tractions) {
    for (int k = 0; k < Dim; ++k) work.nodes.force[load.slot][k] += load.force[k];
  }
}

template void add_tractions<2>(StepWork<2>&, std::size_t);
template void add_tractions<3>(StepWork<3>&, std::size_t);

}  // namespace crampon
