#include "crampon/step/rotation.hpp"

namespace crampon {

template <int Dim>
void carry_rotation(State<Dim>& state, StepWork<Dim>& work, std::size_t b, Spin PieceRotation<Dim>::*spin, double ahead) {
  const NodalVector<Dim> s = splat_as<NodalVector<Dim>>(ahead);
  const auto carried = [&](const SpinProduct<Dim>& turned, NodalVector<Dim> arm) {
    const NodalVector<Dim> once = turned(arm);
    return as_record<Dim>(fused(s, turned(once), once));
  };
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  const Pieces<Dim>& pieces = state.pieces;
  const NodalVector<Dim>* arm = work.nodes.arm.nodes.data();
  Pack* momentum = work.nodes.momentum.nodes.data();
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    const std::uint32_t piece = pieces.in_field(layers.node[l].field);
    if (piece == no_piece) continue;
    const std::size_t first = layers.slot(l, 0);
    if (piece != several_pieces) {
      const SpinProduct<Dim> turned(work.rotations[piece].*spin);
      for (std::size_t i = first; i < first + block_nodes<Dim>; ++i) momentum[i] += carried(turned, arm[i]);
    } else {
      for (std::size_t i = first; i < first + block_nodes<Dim>; ++i) {
        const std::uint32_t its = work.nodes.piece[i].piece;
        if (its < several_pieces) momentum[i] += carried(SpinProduct<Dim>(work.rotations[its].*spin), arm[i]);
      }
    }
  }
}

template <int Dim>
void take_up_couples(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, double dt) {
  const Pieces<Dim>& pieces = state.pieces;
  if (!pieces.any()) return;
  Particles<Dim>& particles = state.particles;
  constexpr int width = motion_packs<Dim>;
  const Block<Dim>& block = work.blocks.list[b];
  for (std::uint32_t r = block.first_run; r < block.end_run; ++r) {
    const Run& run = state.order.runs[r];
    const std::uint32_t of_run = pieces.in_field(model.materials[run.material].field);
    const std::size_t first = std::size_t{run.first_pack} * lanes, end = std::size_t{run.end_pack} * lanes;
    const auto accelerate = [&](std::uint32_t piece, std::size_t from, std::size_t to) {
      if (piece >= several_pieces) return;
      const SpinProduct<Dim> turned(work.rotations[piece].acceleration * dt);
      const NodalVector<Dim> centre = as_nodal(work.rotations[piece].centre);
      for (std::size_t p = from; p < to; ++p) {
        const NodalVector<Dim> dv = turned(leading<Dim>(particles.motion[p * width]) - centre);
        if constexpr (Dim == 2) {
          particles.motion[p] += __builtin_shufflevector(Pair{0., 0.}, dv, 0, 1, 2, 3);
        } else {
          particles.motion[p * width + 1] += dv;
        }
      }
    };
    if (of_run != several_pieces) {
      accelerate(of_run, first, end);
    } else {
      for (std::size_t p = first; p < end; ++p) {
        if (!particles.is_padding(p)) accelerate(pieces.of_particle[particles.id[p]], p, p + 1);
      }
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                   \
  template void carry_rotation<DIM>(State<DIM>&, StepWork<DIM>&, std::size_t, Spin PieceRotation<DIM>::*, double); \
  template void take_up_couples<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t, double);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
