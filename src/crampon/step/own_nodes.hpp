#pragma once
/// Walks over the own nodes of a block.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// f(slot of a node) for the own nodes of a block in all fields but those of rigid bodies.
template <int Dim, class F>
[[gnu::always_inline]] inline void for_deformable(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, F f) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    if (model.is_rigid(layers.node[l].field)) continue;
    const std::size_t first = layers.slot(l, 0);
    for (std::size_t i = first; i < first + block_nodes<Dim>; ++i) f(i);
  }
}

/// f(slot of a node) for the own nodes of a block in all fields.
template <int Dim, class F>
[[gnu::always_inline]] inline void for_own_slots(const StepWork<Dim>& work, std::size_t b, F f) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  const std::size_t first = layers.slot(0, 0), end = layers.slot(layers.node.size(), 0);
  for (std::size_t i = first; i < end; ++i) f(i);
}

}  // namespace crampon
