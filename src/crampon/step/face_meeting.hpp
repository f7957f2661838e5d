#pragma once
/// What groups of nodes and rigid bodies do where they meet at faces (docs/theory/contact.md, rigid faces).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Momentum of a group over its mass, m/s.
template <int Dim>
Vec<Dim> velocity_of(const Nodes<Dim>& nodes, const FaceNodes<Dim>& faces, const FaceGroup<Dim>& group) {
  Vec<Dim> p;
  for (std::uint32_t s = group.first_slot; s < group.end_slot; ++s) {
    for (int k = 0; k < Dim; ++k) p[k] += nodes.momentum[faces.slots[s]][k];
  }
  return p * (1 / group.m);
}

/// The pose of a rigid body at the time of a task's momenta.
template <int Dim>
const RigidPose<Dim>& pose_in(const State<Dim>& state, std::size_t body, ContactTask task) {
  return task == ContactTask::two ? state.rigid[body].start : state.rigid[body].end;
}

}  // namespace crampon
