#include "crampon/step/force_pass.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/mirrored_forces.hpp"
#include "crampon/step/tile_loads.hpp"

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
                          const MaterialField& field = model.contact.fields[model.materials[run.material].field];
                          if (!field.rigid) return;
                          const RigidMotion<Dim>& motion = state.rigid[static_cast<std::size_t>(field.body)];
                          for (int l = 0; l < lanes; ++l) {
                            const std::size_t p = std::size_t{pack} * lanes + l;
                            const Vec<Dim> x = state.particles.position(p);
                            const Vec<Dim> f = (motion.end.velocity_at(x) - motion.start.velocity_at(x)) * (state.particles.mass(p) / dt);
                            NodalVector<Dim> f_p = splat_as<NodalVector<Dim>>(0.);
                            for (int k = 0; k < Dim; ++k) f_p[k] = f[k];
                            for (int n = 0; n < T::stencil; ++n) {
                              at_target<Dim, Shape>(stencil, targets, l, n, tiles, [&](NodalVector<Dim>& q, unsigned flip) {
                                q = fused(splat_as<NodalVector<Dim>>(stencil.weight(n, l)), flipped(f_p, flip), q);
                              });
                            }
                          }
                        });
}

}  // namespace

template <int Dim, class Shape>
void project_other_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, NodalVector<Dim>* tiles) {
  if (!model.rigid_bodies.empty()) project_rigid_motion<Dim, Shape>(state, work, model, b, tiles);
  project_loads<Dim, Shape>(state, work, model, b, tiles);
  project_mirrored_forces<Dim, Shape>(state, work, model, b, tiles);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void project_other_forces<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t, NodalVector<DIM>*);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
