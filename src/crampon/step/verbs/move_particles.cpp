#include "crampon/step/verbs.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/move_pass.hpp"

namespace crampon {

template <int Dim, class Shape>
void move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  finish_particles<Dim, Shape>(state, work, model, b, Strain::done, Accelerate::done);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void move_particles<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
