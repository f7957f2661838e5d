#include "crampon/step/crack_tractions.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim, class Shape>
void share_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  spread_tractions<Dim, Shape>(state, work, model);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void share_tractions<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
