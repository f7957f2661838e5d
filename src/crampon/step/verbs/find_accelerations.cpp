#include "crampon/step/verbs.hpp"

#include "crampon/step/body_work.hpp"
#include "crampon/step/own_nodes.hpp"

namespace crampon {

template <int Dim>
void find_accelerations(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  Nodes<Dim>& nodes = work.nodes;
  // With USL strains follow v'. The others find velocities anew before they are read again.
  const bool keeps = model.stress_update == StressUpdate::usl || acts_on_bodies(work, model);
  for_own_slots(work, b, [&](std::size_t i) {
    const Pack p = nodes.momentum[i];
    const double inverse = p[Dim] > 0 ? 1 / p[Dim] : 0.;
    const NodalVector<Dim> v = leading<Dim>(p * splat(inverse)), a = nodes.force[i] * splat_as<NodalVector<Dim>>(inverse);
    if (keeps) nodes.velocity[i] = v;
    if constexpr (Dim == 2) {
      nodes.motion[i].r[0] = Pack{v[0], v[1], a[0], a[1]};
    } else {
      nodes.motion[i].r[0] = v;
      nodes.motion[i].r[1] = a;
    }
  });
}

template void find_accelerations<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void find_accelerations<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
