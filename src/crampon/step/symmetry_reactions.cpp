#include "crampon/step/symmetry_reactions.hpp"

#include "crampon/step/face_loads.hpp"
#include "crampon/step/folded_pairs.hpp"
#include "crampon/step/instantiate.hpp"
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

/// f(plane, pair's index in the stencil) for the folded pairs of one particle.
template <int Dim, class Shape, class F>
void for_folded(const Model<Dim>& model, const IndexVector<Dim>& first_node, const Stencil<Dim, Shape>& stencil, int l,
                const PairTarget* targets, const Vec<Dim>& x_p, F f) {
  using T = Tile<Dim, Shape>;
  for (int n = 0; n < T::stencil; ++n) {
    if (targets[l * T::stencil + n].flip == 0) continue;
    auto node = unflatten<Dim>(stencil.of.lowest(l) + T::steps[n], T::side);
    for (int k = 0; k < Dim; ++k) node[k] += first_node[k] - T::offset;
    Vec<Dim> x_i = model.grid.node_position(node);
    for_folds<Dim>(model, x_p, node, x_i, [&](const SymmetryPlane& plane) { f(plane, n); });
  }
}

}  // namespace

// Of a pair that is not folded the node hands on all that it is given: its m_p S_ip a_i add up to its forces. A folded pair puts a force f on
// the node with its sign changed, and takes the node's acceleration with its sign changed: of the particle's momentum along the normal
// -m_p S_ip a_i is changed where f was given, and the same mirror image has taken another f from the node. What is missing, -2 (m_p S_ip a_i +
// f), is what the plane does. Damping is none of it: it takes kappa m_p S_ip v_i of the momentum of every pair, folded or not.
template <int Dim, class Shape>
void account_symmetry(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt, const std::vector<Vec<Dim>>& load_values,
                      const Vec<Dim>& body_force, double damping) {
  if (Shape::width < 3 || model.symmetries.empty() || !state.blocks.list[b].has_particles()) return;
  using T = Tile<Dim, Shape>;
  const std::vector<std::uint32_t> packs = folded_packs<Dim, Shape>(state, b);
  if (packs.empty()) return;
  const auto first_node = state.blocks.list[b].first_node();
  const Particles<Dim>& particles = state.particles;
  BlockLedger<Dim>& ledger = state.scratch[b].ledger;
  const MotionRecord<Dim>* motion = gathered<Dim, Shape>(state, b, state.nodes.motion);
  for_packs<Dim, Shape>(
      state, model, b, packs, [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
        if (model.is_rigid(model.materials[run.material].field)) return;
        const Pack* stress = &particles.stress[std::size_t{pack} * stress_size<Dim>];
        for (int l = 0; l < lanes; ++l) {
          const std::size_t p = std::size_t{pack} * lanes + l;
          if (particles.is_padding(p)) continue;
          const double m_p = particles.mass(p), V_p = particles.mass_volume[2 * std::size_t{pack} + 1][l];
          for_folded<Dim, Shape>(model, first_node, stencil, l, targets, particles.position(p), [&](const SymmetryPlane& plane, int n) {
            const PairTarget t = targets[l * T::stencil + n];
            const int d = plane.axis;
            const MotionRecord<Dim>& at = motion[t.layer * T::nodes + t.node];
            const double v = at.r[0][d], a = Dim == 2 ? at.r[0][2 + d] : at.r[motion_packs<Dim> - 1][d];
            double f = m_p * stencil.weight(n, l) * (body_force[d] + a + damping * (v - a * dt));
            for (int k = 0; k < Dim; ++k) f -= V_p * stress[stress_index<Dim>(d, k)][l] * stencil.slope(n, k, l);
            ledger.add_reaction(plane.condition, d, -2 * f);
          });
        }
      });
  for_slots<Dim, Shape>(
      state, model, b, state.scratch[b].loaded,
      [&](const LoadedParticle& loaded, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, const Run&) {
        if (!targets) return;
        const double share = model.loads[loaded.load].share[loaded.entry];
        for_folded<Dim, Shape>(
            model, first_node, stencil, l, targets, particles.position(loaded.slot), [&](const SymmetryPlane& plane, int n) {
              ledger.add_reaction(plane.condition, plane.axis, -2 * stencil.weight(n, l) * share * load_values[loaded.load][plane.axis]);
            });
      });
  for_face_forces<Dim, Shape>(
      state, model, b,
      [&](std::uint32_t slot, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, int n, const NodalVector<Dim>& f) {
        if (!targets) return;
        for_folded<Dim, Shape>(model, first_node, stencil, l, targets, particles.position(slot),
                               [&](const SymmetryPlane& plane, int folded) {
                                 if (folded == n) ledger.add_reaction(plane.condition, plane.axis, -2 * f[plane.axis]);
                               });
      });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                                         \
  template void account_symmetry<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, std::size_t, double, const std::vector<Vec<DIM>>&, \
                                             const Vec<DIM>&, double);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
