#pragma once
/// Body force and damping at nodes: whether there are any, and the work of the body force.

#include "crampon/step/own_nodes.hpp"

namespace crampon {

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

}  // namespace crampon
