#include "crampon/step/filter_velocities.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/rotation.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

// In a series, velocity holds the present term w; the first part of motion is v' and takes up the terms beyond the first.

namespace {

/// f(slot, in a deformable field) for the own nodes of a block in all layers.
template <int Dim, class F>
void for_nodes(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, F f) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    const bool deformable = !model.is_rigid(layers.node[l].field);
    for (int n = 0; n < block_nodes<Dim>; ++n) f(layers.slot(l, n), deformable);
  }
}

template <int Dim>
NodalVector<Dim> moving(const MotionRecord<Dim>& motion) {
  return leading<Dim>(motion.r[0]);
}
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
void start_series(StepWork<Dim>& work, std::size_t b) {
  const double dt = work.now.dt;
  const StepTransfer& transfer = work.now.transfer;
  Nodes<Dim>& nodes = work.nodes;
  const std::size_t first = nodes.layers[b].slot(0, 0), end = nodes.layers[b].slot(nodes.layers[b].node.size(), 0);
  const NodalVector<Dim> back = splat_as<NodalVector<Dim>>(transfer.of_start ? dt : 0.);
  for (std::size_t i = first; i < end; ++i) nodes.velocity[i] = moving(nodes.motion[i]) - back * acceleration(nodes.motion[i]);
}

template <int Dim, class Shape>
void project_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const StepTransfer& transfer = work.now.transfer;
  const int term = work.now.term;
  if (!work.blocks.list[b].has_particles()) return;
  const NodalVector<Dim>* w = gathered<Dim, Shape>(work, b, work.nodes.velocity);
  Pack* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.tile_momentum);
  const PairOffsets<Dim>& faces = work.nodes.layers[b].offsets;
  // Faces move with the first term; in the others they stand still.
  std::vector<Pack> offsets = transfer.of_start ? faces.start : faces.end;
  if (term > 2) std::fill(offsets.begin(), offsets.end(), splat(0.));
  for_packs<Dim, Shape>(state, work, model, b,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run&) {
                          const Pack m_p = state.particles.mass_volume[2 * std::size_t{pack}];
                          Pack record[lanes];
                          for (int l = 0; l < lanes; ++l) {
                            NodalVector<Dim> u = splat_as<NodalVector<Dim>>(0.);
                            for_stencil<Dim, Shape>(stencil, targets, l, w, [&](const NodalVector<Dim>& w_i, int n, const PairTarget& t) {
                              const NodalVector<Dim> read = targets ? flipped(w_i, t.flip) + leading<Dim>(offsets[t.offset]) : w_i;
                              u = fused(splat_as<NodalVector<Dim>>(stencil.weight(n, l)), read, u);
                            });
                            record[l] = as_record<Dim>(u);
                            record[l][Dim] = 1;
                            record[l] *= splat(m_p[l]);
                          }
                          scatter<Dim, Shape>(stencil, targets, offsets.data(), record, tiles);
                        });
}

template <int Dim, class Shape>
void gather_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const StepTransfer& transfer = work.now.transfer;
  const double dt = work.now.dt;
  Nodes<Dim>& nodes = work.nodes;
  const BlockLayers<Dim>& layers = nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(work, b, layers.node[l], nodes.tile_momentum, &nodes.momentum[layers.slot(l, 0)]);
  }
  carry_rotation(state, work, b, &PieceRotation<Dim>::spin_term, (transfer.of_start ? 0. : dt) - state.particles.lead);
  for_nodes(work, model, b, [&](std::size_t i, bool deformable) {
    Pack& p = nodes.momentum[i];
    const double mass = p[Dim];
    p = deformable ? as_record<Dim>(nodes.velocity[i]) * splat(mass) - as_record<Dim>(leading<Dim>(p)) : splat(0.);
    p[Dim] = mass;
  });
}

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
template void start_series<2>(StepWork<2>&, std::size_t);
template void start_series<3>(StepWork<3>&, std::size_t);
#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                \
  template void project_term<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t); \
  template void gather_term<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
