#include "crampon/step/verbs.hpp"

#include "crampon/step/face_loads.hpp"
#include "crampon/step/folded_pairs.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/mirrored_forces.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

namespace {

/// Places of a stress component in the order of Particles::stress.
template <int Dim>
int stress_index(int d, int k) {
  static constexpr int in_plane[2][2] = {{0, 2}, {2, 1}}, in_space[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  return Dim == 2 ? in_plane[d & 1][k & 1] : in_space[d][k];
}

}  // namespace

// Of a pair that is not folded the node hands on all that it is given: its m_p S_ip a_i add up to its forces. A folded pair puts a force f on
// the node with its sign changed, and takes the node's acceleration a with its sign changed, plus the rate of the offset, b: of the
// particle's momentum m_p S_ip (b - a) is changed where f was given, and the same image has taken f - m_p S_ip b from the node. What is
// missing, -2 (m_p S_ip (a - b) + f), is what the plane or face does.
template <int Dim, class Shape>
void account_mirrored_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const double dt = work.now.dt;
  const std::vector<Vec<Dim>>& load_values = work.prescribed.loads;
  const Vec<Dim>& body_force = work.prescribed.body_force;
  const double damping = work.prescribed.damping;
  if (!sees_beyond_faces<Shape> || !work.blocks.list[b].has_particles()) return;
  using T = Tile<Dim, Shape>;
  const std::vector<std::uint32_t> packs = folded_packs<Dim, Shape>(state, work, b);
  if (packs.empty()) return;
  const Particles<Dim>& particles = state.particles;
  const PairOffsets<Dim>& offsets = work.nodes.layers[b].offsets;
  BlockLedger<Dim>& ledger = work.scratch[b].ledger;
  const MotionRecord<Dim>* motion = gathered<Dim, Shape, &Nodes<Dim>::motion>(work, b);
  const HeldNodes<Dim, Shape> held(work, model, b);
  const PairFolder<Dim, Shape> folder(model, held);
  const auto first_node = work.blocks.list[b].first_node();
  const auto fold = [&](const Stencil<Dim, Shape>& stencil, int l, int n, std::size_t p) {
    auto node = unflatten<Dim>(stencil.of.lowest(l) + T::steps[n], T::side);
    for (int k = 0; k < Dim; ++k) node[k] += first_node[k] - T::offset;
    return folder.fold(particles.position(p), node, true);
  };
  const auto react = [&](const FoldedPair<Dim>& pair, int k, double force) {
    ledger.add_reaction(pair.by[k], k, force);
    ledger.boundary_work += force * 0.25 * (pair.offset_start[k] + pair.offset_end[k]) * dt;  // the face has half the offset
  };
  for_folded<Dim, Shape>(
      state, work, model, b, packs, [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, int l, int n, const PairTarget& t) {
        const std::size_t p = std::size_t{pack} * lanes + l;
        const double m = particles.mass(p) * stencil.weight(n, l), V_p = particles.mass_volume[2 * std::size_t{pack} + 1][l];
        const Pack* stress = &particles.stress[std::size_t{pack} * stress_size<Dim>];
        const FoldedPair<Dim> pair = fold(stencil, l, n, p);
        const MotionRecord<Dim>& at = motion[t.layer * T::nodes + t.node];
        for (int k = 0; k < Dim; ++k) {
          const double v = at.r[0][k], a = Dim == 2 ? at.r[0][2 + k] : at.r[motion_packs<Dim> - 1][k];
          const double rate = offsets.motion[t.offset].r[motion_packs<Dim> - 1][Dim == 2 ? 2 + k : k];
          // Velocities of the node, and of what the particle reads, at the start and in the middle of the step.
          const double sign = is_flipped(t.flip, k) ? -1. : 1.;
          const double v_start = v - a * dt, v_middle = v - 0.5 * a * dt;
          const double read_start = sign * v_start + pair.offset_start[k];
          const double read_middle = sign * v_middle + 0.5 * (pair.offset_start[k] + pair.offset_end[k]);
          ledger.body_work += m * body_force[k] * (read_middle - v_middle) * dt;
          ledger.damping += damping * m * (read_start * read_middle - v_start * v_middle) * dt;
          if (!is_flipped(t.flip, k)) continue;
          double f = m * (body_force[k] - damping * read_start);
          for (int j = 0; j < Dim; ++j) f -= V_p * stress[stress_index<Dim>(k, j)][l] * stencil.slope(n, j, l);
          react(pair, k, -2 * (m * (a - rate) + f));
        }
      });
  // A force of a load on one pair: nodes booked its work without the offset.
  const auto book_load = [&](std::uint32_t slot, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, int n, int k,
                             double f) {
    if (!targets || targets[l * T::stencil + n].mirrored == 0) return;
    const PairTarget& t = targets[l * T::stencil + n];
    ledger.load_work += f * 0.5 * (offsets.start[t.offset][k] + offsets.end[t.offset][k]) * dt;
    if (is_flipped(t.flip, k)) react(fold(stencil, l, n, slot), k, -2 * f);
  };
  for_slots<Dim, Shape>(
      state, work, model, b, work.scratch[b].loaded,
      [&](const LoadedParticle& loaded, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, const Run&) {
        const double share = model.loads[loaded.load].share[loaded.entry];
        for (int n = 0; n < T::stencil; ++n) {
          for (int k = 0; k < Dim; ++k)
            book_load(loaded.slot, stencil, l, targets, n, k, stencil.weight(n, l) * share * load_values[loaded.load][k]);
        }
      });
  for_face_forces<Dim, Shape>(
      state, work, model, b,
      [&](std::uint32_t slot, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, int n, const NodalVector<Dim>& f) {
        for (int k = 0; k < Dim; ++k) book_load(slot, stencil, l, targets, n, k, f[k]);
      });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void account_mirrored_forces<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
