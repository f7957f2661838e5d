#include "crampon/step/update_momenta.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

namespace {

/// f(slot of a node) for the own nodes of a block in all fields but those of rigid bodies.
template <int Dim, class F>
void for_deformable(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, F f) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    if (model.is_rigid(layers.node[l].field)) continue;
    const std::size_t first = layers.slot(l, 0);
    for (std::size_t i = first; i < first + block_nodes<Dim>; ++i) f(i);
  }
}

/// f(slot of a node) for the own nodes of a block in all fields.
template <int Dim, class F>
void for_own_slots(const StepWork<Dim>& work, std::size_t b, F f) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  const std::size_t first = layers.slot(0, 0), end = layers.slot(layers.node.size(), 0);
  for (std::size_t i = first; i < end; ++i) f(i);
}

template <int Dim>
bool acts_on_bodies(const StepWork<Dim>& work, const Model<Dim>& model) {
  return work.prescribed.damping != 0 || model.any_body_force();
}

/// Power of the body force on the velocities at hand, over dt.
template <int Dim>
void book_body_work(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, double dt) {
  const Nodes<Dim>& nodes = work.nodes;
  const Vec<Dim>& body_force = work.prescribed.body_force;
  double power = 0;
  for_deformable(work, model, b, [&](std::size_t i) {
    for (int k = 0; k < Dim; ++k) power += nodes.momentum[i][Dim] * body_force[k] * nodes.velocity[i][k];
  });
  work.scratch[b].ledger.body_work += power * dt;
}

}  // namespace

template <int Dim, class Shape>
void assemble_forces(StepWork<Dim>& work, std::size_t b) {
  Nodes<Dim>& nodes = work.nodes;
  const BlockLayers<Dim>& layers = nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(work, b, layers.node[l], nodes.tile_force, &nodes.force[layers.slot(l, 0)]);
  }
}

template <int Dim>
void add_body_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!acts_on_bodies(work, model)) return;
  Nodes<Dim>& nodes = work.nodes;
  NodalVector<Dim> gravity = splat_as<NodalVector<Dim>>(0.);
  for (int k = 0; k < Dim; ++k) gravity[k] = work.prescribed.body_force[k];
  const NodalVector<Dim> damping = splat_as<NodalVector<Dim>>(work.prescribed.damping);
  for_deformable(work, model, b, [&](std::size_t i) {
    const Pack p = nodes.momentum[i];
    nodes.force[i] += splat_as<NodalVector<Dim>>(p[Dim]) * gravity - damping * leading<Dim>(p);
  });
}

template <int Dim>
void add_forces(StepWork<Dim>& work, std::size_t b) {
  Nodes<Dim>& nodes = work.nodes;
  const NodalVector<Dim> dt = splat_as<NodalVector<Dim>>(work.now.dt);
  for_own_slots(work, b, [&](std::size_t i) { nodes.momentum[i] += as_record<Dim>(dt * nodes.force[i]); });
}

template <int Dim>
void account_body_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!acts_on_bodies(work, model)) return;
  const Nodes<Dim>& nodes = work.nodes;
  const double dt = work.now.dt, damping = work.prescribed.damping;
  const Vec<Dim>& body_force = work.prescribed.body_force;
  BlockLedger<Dim>& ledger = work.scratch[b].ledger;
  for_deformable(work, model, b, [&](std::size_t i) {
    const Pack p = nodes.momentum[i];
    const double m = p[Dim];
    const NodalVector<Dim> v_start = nodes.velocity[i];
    const NodalVector<Dim> v = 0.5 * (v_start + leading<Dim>(p * splat(m > 0 ? 1 / m : 0.)));
    for (int k = 0; k < Dim; ++k) {
      ledger.body_work += dt * m * body_force[k] * v[k];
      ledger.damping += dt * damping * m * v_start[k] * v[k];
    }
  });
}

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

template <int Dim>
void take_back_body_work(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  book_body_work(work, model, b, -0.5 * work.now.dt);
}

template <int Dim>
void add_body_work(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  book_body_work(work, model, b, 0.5 * work.now.dt);
}

#define CRAMPON_INSTANTIATE(DIM)                                                          \
  template void add_body_forces<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);     \
  template void add_forces<DIM>(StepWork<DIM>&, std::size_t);                             \
  template void account_body_forces<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t); \
  template void find_accelerations<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);  \
  template void take_back_body_work<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t); \
  template void add_body_work<DIM>(StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void assemble_forces<DIM, SHAPE>(StepWork<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
