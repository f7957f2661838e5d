#include "crampon/step/verbs.hpp"

#include "crampon/step/assemble_momentum.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/rotation.hpp"

namespace crampon {

template <int Dim, class Shape>
void assemble_end_momenta(State<Dim>& state, StepWork<Dim>& work, std::size_t b) {
  assemble_momentum<Dim, Shape>(work, b);
  carry_rotation(state, work, b, &PieceRotation<Dim>::spin_end, work.now.dt - state.particles.lead);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void assemble_end_momenta<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
