#pragma once
/// Rigid bodies: prescribed motion, exact at every step (N13 sec. 3, rigid materials).

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Poses and velocities at the start and the end of the step from the prescribed velocity and spin, integrated by Simpson's rule; serial,
/// as expressions are evaluated here.
template <int Dim>
void start_rigid_motion(State<Dim>& state, const Model<Dim>& model, double dt);

/// Puts the particles of rigid bodies in a block where their bodies are at the start or the end of the step, with their velocities. f(x) is told
/// every position.
template <int Dim, class F>
void place_rigid_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                           RigidPose<Dim> RigidMotion<Dim>::*at, F f) {
  const Block<Dim>& block = work.blocks.list[b];
  for (std::uint32_t r = block.first_run; r < block.end_run; ++r) {
    const Run& run = state.order.runs[r];
    const MaterialField& field = model.contact.fields[model.materials[run.material].field];
    if (!field.rigid) continue;
    const auto body = static_cast<std::size_t>(field.body);
    const RigidPose<Dim>& pose = state.rigid[body].*at;
    for (std::size_t p = std::size_t{run.first_pack} * lanes; p < std::size_t{run.end_pack} * lanes; ++p) {
      const Vec<Dim> x = pose.place(state.particles.original[p] - model.rigid_bodies[body].centre);
      state.particles.set_motion(p, x, pose.velocity_at(x));
      f(x);
    }
  }
}

}  // namespace crampon
