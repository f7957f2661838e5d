#include "crampon/step/ledger.hpp"

#include <algorithm>

#include "crampon/core/parallel.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/particle_view.hpp"

namespace crampon {

template <int Dim, class Shape>
void record_initial_volume(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  using T = Tile<Dim, Shape>;
  const bool by_volume = (!state.cracks.empty() && model.contact.detection == ContactDetection::volume) ||
                         (model.fields.size() > 1 && model.contact.material_detection == ContactDetection::volume);
  if (state.clock.step != 0 || !by_volume || model.contact.reference_volume != ReferenceVolume::initial) return;
  for (std::size_t b = 0; b < work.blocks.size(); ++b) {
    if (!work.blocks.list[b].has_particles()) continue;
    const auto first = work.blocks.list[b].first_node();
    for_packs<Dim, Shape>(
        state, work, model, b, [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
          for (int l = 0; l < lanes; ++l) {
            const double V_p = state.particles.volume(std::size_t{pack} * lanes + l) / model.materials[run.material].thickness;
            for (int n = 0; n < T::stencil; ++n) {
              auto node = unflatten<Dim>(targets ? targets[l * T::stencil + n].node : stencil.of.lowest(l) + T::steps[n], T::side);
              for (int k = 0; k < Dim; ++k) node[k] += first[k] - T::offset;
              state.contacts.initial_volume[model.grid.node_number(node)] += V_p * stencil.weight(n, l);
            }
          }
        });
  }
}

template <int Dim>
void close_step(State<Dim>& state, StepWork<Dim>& work) {
  state.clock.time += work.now.dt;
  ++state.clock.step;
}

template <int Dim>
void close_ledger(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  state.ledger.reactions.assign(model.conditions.size(), {});
  const double in_interfaces = state.ledger.energy.interfaces;
  state.ledger.energy.interfaces = 0;
  state.ledger.rigid_reactions.assign(model.rigid_bodies.size(), {});
  std::int64_t unsolved = 0, crowded = 0;
  for (auto& scratch : work.scratch) {
    BlockLedger<Dim>& ledger = scratch.ledger;
    state.ledger.energy.load_work += ledger.load_work;
    state.ledger.energy.body_work += ledger.body_work;
    state.ledger.energy.boundary_work += ledger.boundary_work;
    state.ledger.energy.damping += ledger.damping;
    state.ledger.energy.transfer_loss += ledger.transfer_loss;
    state.ledger.energy.contact_loss += ledger.contact_loss;
    state.ledger.energy.friction_loss += ledger.friction_loss;
    state.ledger.energy.interfaces += ledger.interface_energy;
    for (const auto& r : ledger.reactions) state.ledger.reactions[r.condition] += r.force;
    for (const auto& r : ledger.rigid) {
      state.ledger.rigid_reactions[r.body].force += r.on_material.force;
      state.ledger.rigid_reactions[r.body].torque += r.on_material.torque;
    }
    unsolved += ledger.unsolved_nodes;
    crowded += ledger.crowded_nodes;
    if (scratch.health.left_margin) state.order.must_reorder = true;
    ledger.clear();
  }
  state.ledger.energy.contact_loss -= state.ledger.energy.interfaces - in_interfaces;  // taken from the particles, but not lost
  state.ledger.most_unsolved_nodes = std::max(state.ledger.most_unsolved_nodes, unsolved);
  state.ledger.most_crowded_nodes = std::max(state.ledger.most_crowded_nodes, crowded);
}

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
  template void close_step<DIM>(State<DIM>&, StepWork<DIM>&);                          \
  template void close_ledger<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);     \
  template ParticleSums<DIM> sum_particles<DIM>(const State<DIM>&, const Model<DIM>&); \
  template void book_departure<DIM>(State<DIM>&, const Model<DIM>&, const Run&, std::size_t);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void record_initial_volume<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
