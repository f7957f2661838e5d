#include "crampon/step/project_forces.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/mirrored_forces.hpp"
#include "crampon/step/project_loads.hpp"
#include "crampon/step/stress_pass.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

namespace {

/// Rigid particles carry the force that takes them from the old velocity to the new one: their nodes then move as prescribed in Task 4.
template <int Dim, class Shape>
void project_rigid_motion(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                          NodalVector<Dim>* tiles) {
  const double dt = work.now.dt;
  using T = Tile<Dim, Shape>;
  for_packs<Dim, Shape>(state, work, model, b,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
                          const MaterialField& field = model.fields[model.materials[run.material].field];
                          if (!field.rigid) return;
                          const RigidMotion<Dim>& motion = state.rigid[static_cast<std::size_t>(field.body)];
                          for (int l = 0; l < lanes; ++l) {
                            const std::size_t p = std::size_t{pack} * lanes + l;
                            const Vec<Dim> x = state.particles.position(p);
                            const Vec<Dim> f = (motion.end.velocity_at(x) - motion.start.velocity_at(x)) * (state.particles.mass(p) / dt);
                            NodalVector<Dim> f_p = splat_as<NodalVector<Dim>>(0.);
                            for (int k = 0; k < Dim; ++k) f_p[k] = f[k];
                            for (int n = 0; n < T::stencil; ++n) {
                              const PairTarget* t = targets ? &targets[l * T::stencil + n] : nullptr;
                              NodalVector<Dim>& q = tiles[t ? t->layer * T::nodes + t->node : stencil.of.base[l] + T::steps[n]];
                              q = fused(splat_as<NodalVector<Dim>>(stencil.weight(n, l)), flipped(f_p, t ? t->flip : 0u), q);
                            }
                          }
                        });
}

/// Internal forces of a pack (N03 Eq. 28) into tiles.
template <int Dim, class Shape>
auto internal_forces(const Particles<Dim>& particles, NodalVector<Dim>* tiles) {
  return [&particles, tiles](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run&) {
    scatter_force<Dim, Shape>(stencil, targets, particles.mass_volume[2 * std::size_t{pack} + 1],
                              &particles.stress[std::size_t{pack} * stress_size<Dim>], tiles);
  };
}

template <int Dim, class Shape>
void project_other_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, NodalVector<Dim>* tiles) {
  if (!model.rigid_bodies.empty()) project_rigid_motion<Dim, Shape>(state, work, model, b, tiles);
  project_loads<Dim, Shape>(state, work, model, b, tiles);
  project_mirrored_forces<Dim, Shape>(state, work, model, b, tiles);
}

}  // namespace

template <int Dim, class Shape>
void update_stress_and_project_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!work.blocks.list[b].has_particles()) return;
  NodalVector<Dim>* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.tile_force);
  update_stress<Dim, Shape>(state, work, model, b, work.now.stress_dt, gathered<Dim, Shape>(work, b, work.nodes.velocity),
                            work.nodes.layers[b].offsets.start, internal_forces<Dim, Shape>(state.particles, tiles));
  project_other_forces<Dim, Shape>(state, work, model, b, tiles);
}

template <int Dim, class Shape>
void project_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (!work.blocks.list[b].has_particles()) return;
  NodalVector<Dim>* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.tile_force);
  for_packs<Dim, Shape>(state, work, model, b, internal_forces<Dim, Shape>(state.particles, tiles));
  project_other_forces<Dim, Shape>(state, work, model, b, tiles);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                                    \
  template void update_stress_and_project_forces<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t); \
  template void project_forces<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
