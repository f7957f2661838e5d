#include "crampon/step/particle_sums.hpp"

#include "crampon/core/parallel.hpp"
#include "crampon/step/particle_view.hpp"

namespace crampon {

namespace {

/// Of the chosen lanes of a pack.
template <int Dim, class Chosen>
void add_pack(const State<Dim>& state, const Model<Dim>& model, const Run& run, std::size_t pack, Chosen chosen, ParticleSums<Dim>& sum) {
  const Particles<Dim>& particles = state.particles;
  const PackView<Dim> view(state, model, run.material, pack);
  const Pack volume = particles.mass_volume[2 * pack + 1], strain = view.report().energy * volume, dissipated = view.dissipated() * volume;
  for (int l = 0; l < lanes; ++l) {
    const std::size_t p = pack * lanes + l;
    if (!chosen(p)) continue;
    const double m = particles.mass(p);
    const Vec<Dim> v = particles.velocity(p), x = particles.present_position(p);
    sum.mass += m;
    sum.kinetic += 0.5 * m * dot(v, v);
    sum.strain += strain[l];
    sum.dissipated += dissipated[l];
    sum.momentum += v * m;
    sum.angular += m * (x[0] * v[1] - x[1] * v[0]);
  }
}

}  // namespace

template <int Dim>
ParticleSums<Dim> sum_particles(const State<Dim>& state, const Model<Dim>& model) {
  std::vector<ParticleSums<Dim>> parts(state.order.runs.size());
  parallel_for(parts.size(), model.threads, [&](std::size_t r) {
    const Run& run = state.order.runs[r];
    if (model.is_rigid(model.materials[run.material].field)) return;
    for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
      add_pack(
          state, model, run, k, [&](std::size_t p) { return !state.particles.is_padding(p); }, parts[r]);
    }
  });
  ParticleSums<Dim> total;
  for (const auto& part : parts) total += part;
  return total;
}

template <int Dim>
void book_departure(State<Dim>& state, const Model<Dim>& model, const Run& run, std::size_t particle) {
  if (model.is_rigid(model.materials[run.material].field)) return;
  add_pack(
      state, model, run, particle / lanes, [&](std::size_t p) { return p == particle; }, state.ledger.left);
}

#define CRAMPON_INSTANTIATE(DIM)                                                       \
  template ParticleSums<DIM> sum_particles<DIM>(const State<DIM>&, const Model<DIM>&); \
  template void book_departure<DIM>(State<DIM>&, const Model<DIM>&, const Run&, std::size_t);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
