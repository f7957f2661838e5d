#pragma once
/// The walk over the particles of a block on which they take velocities from nodes (Task 5; step/transfer.hpp).

#include "crampon/step/interpolate.hpp"
#include "crampon/step/rotation.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

/// {v', a}: of nodes, at the particle p.
template <int Dim>
void take_velocity(Particles<Dim>& particles, std::size_t p, const MotionRecord<Dim>& m, const VelocityRule& rule,
                   BlockLedger<Dim>& ledger) {
  const Vec<Dim> V = particles.velocity(p);
  Vec<Dim> g, taken, damped;
  for (int k = 0; k < Dim; ++k) {
    const double v = m.r[0][k], a = Dim == 2 ? m.r[0][2 + k] : m.r[motion_packs<Dim> - 1][k];
    g[k] = a * rule.dt;
    taken[k] = rule.own * V[k] + rule.nodal * v + rule.gain * a;
    damped[k] = taken[k] - rule.damped * V[k];
  }
  // Kinetic energy that is missing then, and work on strain that changes with it.
  const auto loss = [&](const Vec<Dim>& from, const Vec<Dim>& to) {
    return particles.mass(p) * (0.5 * (dot(from, from) - dot(to, to)) + rule.strain_share * dot(g, to - from));
  };
  const double of_nodes = rule.nodal > 0 ? loss(V + g, taken) : 0.;
  ledger.transfer_loss += (1 - rule.share_of_damping) * of_nodes;
  ledger.damping += rule.share_of_damping * of_nodes + loss(taken, damped);
  particles.set_motion(p, particles.position(p), damped);
}

/// `then(pack, stencil, targets)` follows for every pack.
template <int Dim, class Shape, class Then>
[[gnu::always_inline]] inline void for_taken(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                                             const VelocityRule& rule, Then&& then) {
  const MotionRecord<Dim>* motion = gathered<Dim, Shape, &Nodes<Dim>::motion>(work, b);
  const auto& offsets = work.nodes.layers[b].offsets.motion;
  BlockLedger<Dim>& ledger = work.scratch[b].ledger;
  take_up_couples(state, work, model, b, rule.dt);
  for_packs<Dim, Shape>(state, work, model, b,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
                          const bool deformable = !model.is_rigid(model.materials[run.material].field);
                          for (int l = 0; l < lanes && deformable; ++l) {
                            const std::size_t p = std::size_t{pack} * lanes + static_cast<std::size_t>(l);
                            take_velocity(state.particles, p, interpolate<Dim, Shape>(stencil, targets, l, motion, offsets), rule, ledger);
                          }
                          then(pack, stencil, targets);
                        });
}

}  // namespace crampon
