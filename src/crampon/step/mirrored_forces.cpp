#include "crampon/step/mirrored_forces.hpp"

#include "crampon/step/folded_pairs.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

template <int Dim, class Shape>
void project_mirrored_forces(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                             NodalVector<Dim>* tiles) {
  const Vec<Dim>& body_force = work.prescribed.body_force;
  const double damping = work.prescribed.damping;
  using T = Tile<Dim, Shape>;
  const PairOffsets<Dim>& offsets = work.nodes.layers[b].offsets;
  if (!model.any_body_force() && !offsets.any()) return;
  const std::vector<std::uint32_t> packs = folded_packs<Dim, Shape>(state, work, b);
  if (packs.empty()) return;
  for_folded<Dim, Shape>(state, work, model, b, packs,
                         [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, int l, int n, const PairTarget& t) {
                           const double m = state.particles.mass(std::size_t{pack} * lanes + l) * stencil.weight(n, l);
                           NodalVector<Dim>& f = tiles[t.layer * T::nodes + t.node];
                           for (int k = 0; k < Dim; ++k) {
                             const double rate = offsets.motion[t.offset].r[motion_packs<Dim> - 1][Dim == 2 ? 2 + k : k];
                             const double follows = m * (rate + damping * offsets.start[t.offset][k]);
                             f[k] += is_flipped(t.flip, k) ? follows - 2 * m * body_force[k] : -follows;
                           }
                         });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                                      \
  template void project_mirrored_forces<DIM, SHAPE>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, std::size_t, \
                                                    NodalVector<DIM>*);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
