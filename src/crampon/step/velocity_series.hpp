#pragma once
/// XPIC and FMPM (step/transfer.hpp): the velocities of nodes without what particles could not have given them. With A the way from nodes to
/// particles and back, A w = m^-1 S^T m S w, the terms of the series are w_1 = v, w_l = (I - A) w_(l-1), and v^(k) is the sum of the first k.
///
/// In a series, Nodes::velocity holds the present term w. The first part of Nodes::motion is v' and takes up the terms beyond the first.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// f(slot, in a deformable field) for the own nodes of a block in all layers.
template <int Dim, class F>
[[gnu::always_inline]] inline void for_nodes(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, F f) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    const bool deformable = !model.is_rigid(layers.node[l].field);
    for (int n = 0; n < block_nodes<Dim>; ++n) f(layers.slot(l, n), deformable);
  }
}

/// The velocity that particles read.
template <int Dim>
NodalVector<Dim> moving(const MotionRecord<Dim>& motion) {
  return leading<Dim>(motion.r[0]);
}

}  // namespace crampon
