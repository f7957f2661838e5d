#include "crampon/step/crack_carriers.hpp"

#include <algorithm>

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"

namespace crampon {

template <int Dim>
void drop_lost_carriers(State<Dim>& state, StepWork<Dim>& work) {
  for (auto& crack : state.cracks.list) {
    for (Carriers* side : {&crack.upper_carriers, &crack.lower_carriers}) {
      for (std::vector<Carrier>& carriers : *side) {
        const bool lost = std::any_of(carriers.begin(), carriers.end(),
                                      [&](const Carrier& c) { return work.places.slot_of_id[c.particle] == padding_id; });
        if (lost) carriers.clear();
      }
    }
  }
}

template <int Dim>
Vec<Dim> carried_displacement(const State<Dim>& state, const StepWork<Dim>& work, const std::vector<Carrier>& carriers, PositionTime time) {
  Vec<Dim> sum{};
  for (const Carrier& c : carriers) {
    const std::uint32_t slot = work.places.slot_of_id[c.particle];
    const Particles<Dim>& particles = state.particles;
    const Vec<Dim> x = time == PositionTime::present ? particles.present_position(slot) : particles.position(slot),
                   u = x - particles.original[slot];
    for (int k = 0; k < Dim; ++k) sum[k] += (c.flip >> k & 1u ? -c.weight : c.weight) * u[k];
  }
  return sum;
}

template <int Dim, class Shape>
void find_nodes_of_point(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, const std::vector<Carrier>& carriers,
                         std::vector<NodeOfPoint>& nodes) {
  using T = Tile<Dim, Shape>;
  nodes.clear();
  StencilFactors<Dim, Shape> factors;
  for (const Carrier& carrier : carriers) {
    const std::uint32_t slot = work.places.slot_of_id[carrier.particle], pack = slot / lanes;
    const std::uint32_t b = work.places.block_of_pack[pack];
    const Block<Dim>& block = work.blocks.list[b];
    const BlockLayers<Dim>& layers = work.nodes.layers[b];
    BlockStencils<Dim, Shape> stencils(state, work, model, b);
    std::uint32_t r = block.first_run;
    while (pack >= state.order.runs[r].end_pack) ++r;
    stencils.enter_run(r);
    stencils.compute(pack, factors);
    const PairTarget* targets = stencils.targets(pack);
    const int lane = static_cast<int>(slot % lanes);
    for (int n = 0; n < T::stencil; ++n) {
      const double weight = factors.weight(n, lane) * carrier.weight;
      if (weight == 0) continue;
      const PairTarget target =
          targets ? targets[lane * T::stencil + n]
                  : PairTarget{static_cast<std::uint16_t>(factors.lowest(lane) + T::steps[n]), static_cast<std::uint8_t>(factors.layer), 0};
      IndexVector<Dim> local = unflatten<Dim>(target.node, T::side);
      int neighbour = 0, stride = 1, node = 0, node_stride = 1;
      for (int k = 0; k < Dim; ++k) {
        local[k] -= T::offset;
        const int step = local[k] < 0 ? -1 : local[k] >= block_side ? 1 : 0;
        local[k] -= step * block_side;
        neighbour += (step + 1) * stride;
        stride *= 3;
        node += local[k] * node_stride;
        node_stride *= block_side;
      }
      NodeOfPoint at;
      at.block = block.neighbours[neighbour];
      const BlockLayers<Dim>& there = work.nodes.layers[at.block];
      at.slot = there.slot(layer_of<Dim>(there.node, layers.tile[target.layer]), node);
      at.flip = static_cast<std::uint8_t>(carrier.flip ^ target.flip);
      auto same = std::find_if(nodes.begin(), nodes.end(), [&](const NodeOfPoint& q) { return q.slot == at.slot && q.flip == at.flip; });
      if (same == nodes.end()) same = nodes.insert(nodes.end(), at);
      same->weight += weight;
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                                                  \
  template void find_nodes_of_point<DIM, SHAPE>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, const std::vector<Carrier>&, \
                                                std::vector<NodeOfPoint>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM)                                      \
  template void drop_lost_carriers<DIM>(State<DIM>&, StepWork<DIM>&); \
  template Vec<DIM> carried_displacement<DIM>(const State<DIM>&, const StepWork<DIM>&, const std::vector<Carrier>&, PositionTime);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
