#include "crampon/step/verbs.hpp"

#include "crampon/step/velocity_series.hpp"

namespace crampon {

namespace {

template <int Dim>
void set_moving(MotionRecord<Dim>& motion, NodalVector<Dim> v) {
  if constexpr (Dim == 2) {
    motion.r[0] = Pack{v[0], v[1], motion.r[0][2], motion.r[0][3]};
  } else {
    motion.r[0] = v;
  }
}

}  // namespace

template <int Dim>
void add_term(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  Nodes<Dim>& nodes = work.nodes;
  for_nodes(work, model, b, [&](std::size_t i, bool) {
    const Pack p = nodes.momentum[i];
    nodes.velocity[i] = leading<Dim>(p * splat(p[Dim] > 0 ? 1 / p[Dim] : 0.));
    set_moving(nodes.motion[i], moving(nodes.motion[i]) + nodes.velocity[i]);
  });
}

template void add_term<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void add_term<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
