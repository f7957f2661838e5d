#include "crampon/step/move_pass.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/interpolate.hpp"
#include "crampon/step/lay_out_blocks.hpp"
#include "crampon/step/rigid_motion.hpp"
#include "crampon/step/rotation.hpp"
#include "crampon/step/stress_pass.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

namespace {

/// Which parts of {x, v} advance with {v', a}.
template <int Dim>
struct Advance {
  Pack factor[motion_packs<Dim>];
  Advance(double dt_position, double dt_velocity) {
    if constexpr (Dim == 2) {
      factor[0] = Pack{dt_position, dt_position, dt_velocity, dt_velocity};
    } else {
      factor[0] = splat(dt_position);
      factor[1] = splat(dt_velocity);
    }
  }
  void apply(Particles<Dim>& particles, std::size_t p, const MotionRecord<Dim>& m) const {
    for (int r = 0; r < motion_packs<Dim>; ++r) {
      Pack& q = particles.motion[p * motion_packs<Dim> + r];
      q = fused(factor[r], m.r[r], q);
    }
  }
};

/// Before the step, lead_positions() has moved the particle on by the time `further`, s, with the particle's own velocity. The velocity
/// that moves particles in this step was not known then. Replaces the one by the other for that time.
template <int Dim>
void correct_lead(Particles<Dim>& particles, std::size_t p, const MotionRecord<Dim>& m, double further) {
  const Vec<Dim> v = particles.velocity(p);
  Pack& x = particles.motion[p * motion_packs<Dim>];
  for (int k = 0; k < Dim; ++k) x[k] += further * (m.r[0][k] - v[k]);
}

/// r <- (I + L dt) r for the half edges of the domains of a pack: their corners move with the nodes, as positions do.
template <int Dim>
void stretch_domains(Particles<Dim>& particles, std::uint32_t pack, const Pack* L, double dt) {
  Pack* r = &particles.domain[std::size_t{pack} * domain_size<Dim>];
  for (int j = 0; j < Dim; ++j) {
    Pack change[Dim];
    for (int i = 0; i < Dim; ++i) {
      change[i] = L[i * Dim] * r[j];
      for (int k = 1; k < Dim; ++k) change[i] = fused(L[i * Dim + k], r[k * Dim + j], change[i]);
    }
    for (int i = 0; i < Dim; ++i) r[i * Dim + j] = fused(splat(dt), change[i], r[i * Dim + j]);
  }
}

/// Particles take up what the nodes in contact beside them have gained: the mean over those nodes.
template <int Dim, class Shape>
void remember_contact(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const Pack* gains = gathered<Dim, Shape, &Nodes<Dim>::contact_gain>(work, b);
  for_packs<Dim, Shape>(state, work, model, b,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run&) {
                          for (int l = 0; l < lanes; ++l) {
                            double gain = 0, weight = 0;
                            for_stencil<Dim, Shape>(stencil, targets, l, gains, [&](Pack at_node, int n, const PairTarget&) {
                              gain += stencil.weight(n, l) * at_node[0];
                              weight += stencil.weight(n, l) * at_node[1];
                            });
                            if (weight > 0) state.particles.contact[std::size_t{pack} * lanes + l] += gain / weight;
                          }
                        });
}

template <int Dim, class Shape>
void move_block(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, Strain strain, Accelerate accelerate) {
  const double dt = work.now.dt, further = work.now.further;
  if (!work.blocks.list[b].has_particles()) return;
  Particles<Dim>& particles = state.particles;
  if (particles.contact.size() > 0 && work.nodes.layers[b].sums_contact) remember_contact<Dim, Shape>(state, work, model, b);
  if (accelerate == Accelerate::now) take_up_couples(state, work, model, b, dt);
  const MotionRecord<Dim>* motion = gathered<Dim, Shape, &Nodes<Dim>::motion>(work, b);
  const Advance<Dim> advance(dt, accelerate == Accelerate::now ? dt : 0.);
  const PairOffsets<Dim>& offsets = work.nodes.layers[b].offsets;
  Vec<Dim>* moved_with = particles.watched ? particles.moved_with.data() : nullptr;
  const bool corrects = further != 0;
  constexpr int position_pack = 0, width = motion_packs<Dim>;
  Pack low = splat(1e300), high = splat(-1e300), fastest = splat(0.), check = splat(0.);
  const auto move = [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run&)
      __attribute__((always_inline)) {
    Pack lowest = low, highest = high, speed = fastest, bad = check;  // in registers
    for (int l = 0; l < lanes; ++l) {
      const std::size_t p = std::size_t{pack} * lanes + l;
      const MotionRecord<Dim> m = interpolate<Dim, Shape>(stencil, targets, l, motion, offsets.motion);
      advance.apply(particles, p, m);
      if (moved_with) {
        for (int k = 0; k < Dim; ++k) moved_with[p][k] = m.r[0][k];
      }
      if (corrects) correct_lead(particles, p, m, further);
      const Pack x = particles.motion[p * width + position_pack];
      lowest = lane_min(lowest, x);
      highest = lane_max(highest, x);
      speed = lane_max(speed, lane_max(m.r[0], -m.r[0]));
      for (int r = 0; r < width; ++r) bad += particles.motion[p * width + r] * 0.;  // NaN and infinity stay
    }
    low = lowest, high = highest, fastest = speed, check = bad;
  };
  const NodalVector<Dim>* end_velocity =
      Shape::has_domains || strain == Strain::now ? gathered<Dim, Shape, &Nodes<Dim>::velocity>(work, b) : nullptr;
  const auto walk = [&](const auto& visit) {
    if (strain == Strain::now) {
      update_stress<Dim, Shape>(state, work, model, b, work.now.stress_dt, end_velocity, offsets.end, visit);
    } else {
      for_packs<Dim, Shape>(state, work, model, b, visit);
    }
  };
  if constexpr (Shape::has_domains) {
    walk([&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
      if (!model.is_rigid(model.materials[run.material].field)) {
        Pack L[Dim * Dim];
        gradient<Dim, Shape>(stencil, targets, offsets.end.data(), end_velocity, L);
        stretch_domains(particles, pack, L, dt + further);
      }
      move(pack, stencil, targets, run);
    });
  } else {
    walk(move);
  }
  if (!model.rigid_bodies.empty()) {
    place_rigid_particles(state, work, model, b, &RigidMotion<Dim>::end, [&](const Vec<Dim>& x) {
      for (int k = 0; k < Dim; ++k) low[k] = std::fmin(low[k], x[k]), high[k] = std::fmax(high[k], x[k]);
    });
  }
  BlockHealth& health = work.scratch[b].health;
  for (int l = 0; l < lanes; ++l) {
    if (check[l] != 0) health.bad_number = true;
  }
  if (health.bad_number) return;
  for (int k = 0; k < Dim; ++k) {
    if (fastest[k] * dt > model.grid.cell[k]) health.moved_too_far = true;
  }
  find_touched_box<Dim, Shape>(work, model, b, low, high);
}

}  // namespace

template <int Dim, class Shape>
void finish_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, Strain strain,
                      Accelerate accelerate) {
  move_block<Dim, Shape>(state, work, model, b, strain, accelerate);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void finish_particles<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t, Strain, Accelerate);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
