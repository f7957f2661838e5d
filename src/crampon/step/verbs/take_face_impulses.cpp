#include "crampon/step/verbs.hpp"

#include "crampon/step/contact_booking.hpp"
#include "crampon/step/face_meeting.hpp"

namespace crampon {

template <int Dim>
void take_face_impulses(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, ContactTask task) {
  const double dt = work.now.dt;
  FaceNodes<Dim>& faces = work.scratch[b].face_nodes;
  BlockLedger<Dim>& ledger = work.scratch[b].ledger;
  const bool re_extrapolates = model.transfer_in(state.clock.step).re_extrapolates;
  for (FacePart<Dim>& part : faces.parts) {
    const FaceGroup<Dim>& group = faces.groups[part.group];
    if (task == ContactTask::term) continue;
    const RigidPose<Dim>& pose = pose_in(state, part.body, task);
    const Vec<Dim> v = pose.velocity_at(group.x);
    const double given = part.of_rigid.book(task, v, -part.dp, v, re_extrapolates);
    ledger.boundary_work += given;
    ledger.contact_loss += given;
    if (task == ContactTask::four) book_reaction(ledger, part.body, state.rigid[part.body].start, group.x, part.dp * (1 / dt));
  }
  for (FaceGroup<Dim>& group : faces.groups) {
    if (task != ContactTask::term) ledger.contact_loss += group.account.book(task, group.before, group.dp, group.v, re_extrapolates);
    for (std::uint32_t s = group.first_slot; s < group.end_slot; ++s) {
      const std::size_t i = faces.slots[s];
      change_node(work.nodes, i, group.dp * (work.nodes.momentum[i][Dim] / group.m), task, dt);
    }
  }
}

template void take_face_impulses<2>(State<2>&, StepWork<2>&, const Model<2>&, std::size_t, ContactTask);
template void take_face_impulses<3>(State<3>&, StepWork<3>&, const Model<3>&, std::size_t, ContactTask);

}  // namespace crampon
