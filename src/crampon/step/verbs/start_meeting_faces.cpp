#include "crampon/step/verbs.hpp"

#include "crampon/step/contact_booking.hpp"
#include "crampon/step/face_meeting.hpp"
#include "crampon/step/fixed_components.hpp"

namespace crampon {

namespace {

/// No node has anything yet for particles to add to their memory of contact.
template <int Dim>
void forget_gains(StepWork<Dim>& work, std::size_t b) {
  const std::size_t count = work.nodes.layers[b].node.size() * block_nodes<Dim>;
  for (std::size_t i = 0; i < count; ++i) work.nodes.contact_gain[work.nodes.layers[b].slot(0, 0) + i] = splat(0.);
}

}  // namespace

template <int Dim>
void start_meeting_faces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, ContactTask task) {
  if (task == ContactTask::four && state.particles.contact.size() > 0) forget_gains(work, b);
  FaceNodes<Dim>& faces = work.scratch[b].face_nodes;
  const bool imposed_before = fixes_before_contact(model, task);
  for (FaceGroup<Dim>& group : faces.groups) {
    group.before = velocity_of(work.nodes, faces, group);
    group.fixed_axes = imposed_before ? fixed_axes(work, b, group.node) : 0u;
  }
}

template void start_meeting_faces<2>(State<2>&, StepWork<2>&, const Model<2>&, std::size_t, ContactTask);
template void start_meeting_faces<3>(State<3>&, StepWork<3>&, const Model<3>&, std::size_t, ContactTask);

}  // namespace crampon
