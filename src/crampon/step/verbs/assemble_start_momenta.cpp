#include "crampon/step/verbs.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/assemble_momentum.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/rotation.hpp"
#include "crampon/step/rotation_sums.hpp"

namespace crampon {

namespace {

/// Arms of a block's nodes, kg m; its momenta are assembled.
template <int Dim, class Shape>
void assemble_arms(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  Nodes<Dim>& nodes = work.nodes;
  const BlockLayers<Dim>& layers = nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    const std::uint32_t piece = state.pieces.in_field(layers.node[l].field);
    if (piece == no_piece) continue;
    assemble_layer<Dim, Shape>(work, b, l, nodes.arm);
    if (piece == several_pieces) assemble_layer<Dim, Shape>(work, b, l, nodes.piece);
  }
  const auto origin_of = [&](std::uint32_t piece) { return state.pieces.list[piece].origin; };
  for_turning_nodes(state, work, model, b, origin_of, [&](std::size_t i, NodalVector<Dim> r, std::uint32_t) {
    nodes.arm[i] = splat_as<NodalVector<Dim>>(nodes.momentum[i][Dim]) * r - nodes.arm[i];
  });
}

}  // namespace

template <int Dim, class Shape>
void assemble_start_momenta(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (work.nodes.layers[b].shared.empty()) assemble_momentum<Dim, Shape>(work, b);  // else find_shared_nodes has
  assemble_arms<Dim, Shape>(state, work, model, b);
  carry_rotation(state, work, b, &PieceRotation<Dim>::spin, -state.particles.lead);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void assemble_start_momenta<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
