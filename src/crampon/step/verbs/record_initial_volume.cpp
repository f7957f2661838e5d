#include "crampon/step/verbs.hpp"

#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"

namespace crampon {

template <int Dim, class Shape>
void record_initial_volume(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  using T = Tile<Dim, Shape>;
  const bool by_volume = (!state.cracks.empty() && model.contact.detection == ContactDetection::volume) ||
                         (model.contact.several_fields() && model.contact.material_detection == ContactDetection::volume);
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

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void record_initial_volume<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
