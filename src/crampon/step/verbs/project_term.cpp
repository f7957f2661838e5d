#include "crampon/step/verbs.hpp"

#include <algorithm>

#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

template <int Dim, class Shape>
void project_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const StepTransfer& transfer = work.now.transfer;
  const int term = work.now.term;
  if (!work.blocks.list[b].has_particles()) return;
  const NodalVector<Dim>* w = gathered<Dim, Shape, &Nodes<Dim>::velocity>(work, b);
  Pack* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.momentum);
  const PairOffsets<Dim>& faces = work.nodes.layers[b].offsets;
  // Faces move with the first term; in the others they stand still.
  std::vector<Pack> offsets = transfer.of_start ? faces.start : faces.end;
  if (term > 2) std::fill(offsets.begin(), offsets.end(), splat(0.));
  for_packs<Dim, Shape>(state, work, model, b,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run&) {
                          const Pack m_p = state.particles.mass_volume[2 * std::size_t{pack}];
                          Pack record[lanes];
                          for (int l = 0; l < lanes; ++l) {
                            NodalVector<Dim> u = splat_as<NodalVector<Dim>>(0.);
                            for_stencil<Dim, Shape>(stencil, targets, l, w, [&](const NodalVector<Dim>& w_i, int n, const PairTarget& t) {
                              const NodalVector<Dim> read = targets ? flipped(w_i, t.flip) + leading<Dim>(offsets[t.offset]) : w_i;
                              u = fused(splat_as<NodalVector<Dim>>(stencil.weight(n, l)), read, u);
                            });
                            record[l] = as_record<Dim>(u);
                            record[l][Dim] = 1;
                            record[l] *= splat(m_p[l]);
                          }
                          scatter<Dim, Shape>(stencil, targets, offsets.data(), record, tiles);
                        });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void project_term<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
