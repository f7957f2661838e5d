#pragma once
/// Sums over the nodes that have a part in the rotation of a piece (step/rotation.hpp), by piece.

#include <algorithm>
#include <array>
#include <vector>

#include "crampon/state/rotation.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// f(slot, from a point to the node) for the own nodes of a block in a layer.
template <int Dim, class F>
[[gnu::always_inline]] inline void for_own_nodes(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, std::size_t layer,
                                                 const Vec<Dim>& point, F f) {
  std::size_t slot = work.nodes.layers[b].slot(layer, 0);
  const NodalVector<Dim> first = as_nodal(model.grid.node_position(work.blocks.list[b].first_node()) - point);
  const NodalVector<Dim> cell = as_nodal(model.grid.cell);
  const auto at = [&](int i, int j, int k) {
    NodalVector<Dim> n = splat_as<NodalVector<Dim>>(0.);
    n[0] = i, n[1] = j;
    if constexpr (Dim == 3) n[2] = k;
    return fused(n, cell, first);
  };
#pragma GCC unroll 4
  for (int k = 0; k < (Dim == 3 ? block_side : 1); ++k) {
#pragma GCC unroll 4
    for (int j = 0; j < block_side; ++j) {
#pragma GCC unroll 4
      for (int i = 0; i < block_side; ++i) f(slot++, at(i, j, k));
    }
  }
}

/// f(slot, from point_of(piece) to the node, piece) for the own nodes of a block that have a part in the rotation of a piece.
template <int Dim, class Point, class F>
[[gnu::always_inline]] inline void for_turning_nodes(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model,
                                                     std::size_t b, Point point_of, F f) {
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    const std::uint32_t piece = state.pieces.in_field(layers.node[l].field);
    if (piece == no_piece) continue;
    if (piece != several_pieces) {
      for_own_nodes(work, model, b, l, point_of(piece), [&](std::size_t i, NodalVector<Dim> r) { f(i, r, piece); });
    } else {
      for_own_nodes(work, model, b, l, Vec<Dim>{}, [&](std::size_t i, NodalVector<Dim> x) {
        const std::uint32_t its = work.nodes.piece[i].piece;
        if (its < several_pieces) f(i, x - as_nodal(point_of(its)), its);
      });
    }
  }
}

/// The centre of mass of a piece.
template <int Dim>
auto centres(const StepWork<Dim>& work) {
  return [&work](std::uint32_t piece) { return work.rotations[piece].centre; };
}

/// The entry of a piece among those of a block.
inline RotationCouple& couple_of(std::vector<RotationCouple>& couples, std::uint32_t piece) {
  const auto at = std::find_if(couples.begin(), couples.end(), [&](const RotationCouple& c) { return c.piece == piece; });
  if (at != couples.end()) return *at;
  couples.push_back({piece, {}, {}, {}});
  return couples.back();
}

/// The couples of all blocks, by piece.
template <int Dim>
std::vector<RotationCouple> total_couples(const State<Dim>& state, const StepWork<Dim>& work) {
  std::vector<RotationCouple> total(state.pieces.list.size());
  for (const BlockScratch<Dim>& scratch : work.scratch) {
    for (const RotationCouple& part : scratch.couples) {
      RotationCouple& sum = total[part.piece];
      sum.couple += part.couple;
      sum.torque += part.torque;
      sum.read += part.read;
    }
  }
  return total;
}

/// Sums of cross products at the nodes of a block, piece after piece; `hand_over(couple, sums)` when another begins.
template <int Dim, int N, class HandOver>
class SumsOfPieces {
 public:
  SumsOfPieces(std::vector<RotationCouple>& couples, HandOver hand_over) : couples_(couples), hand_over_(hand_over) {}
  ~SumsOfPieces() { finish(); }
  SumsOfPieces(const SumsOfPieces&) = delete;
  SumsOfPieces& operator=(const SumsOfPieces&) = delete;

  [[gnu::always_inline]] std::array<CrossSum<Dim>, N>& of(std::uint32_t piece) {
    if (piece != piece_) {
      finish();
      piece_ = piece;
      sums_ = {};
    }
    return sums_;
  }

 private:
  void finish() {
    if (piece_ != no_piece) hand_over_(couple_of(couples_, piece_), sums_);
  }
  std::vector<RotationCouple>& couples_;
  HandOver hand_over_;
  std::uint32_t piece_ = no_piece;
  std::array<CrossSum<Dim>, N> sums_{};
};

enum class ReadVelocity { motion, term };
/// The angular momentum that particles get by taking velocities from a block's nodes: v' of Task 4, or a term of a series.
template <int Dim>
void sum_read_rotation(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, ReadVelocity read) {
  const Nodes<Dim>& nodes = work.nodes;
  std::vector<RotationCouple>& couples = work.scratch[b].couples;
  for (RotationCouple& couple : couples) couple.read = {};
  const auto hand_over = [](RotationCouple& c, const auto& sums) { c.read += sums[0].total(); };
  SumsOfPieces<Dim, 1, decltype(hand_over)> sums(couples, hand_over);
  for_turning_nodes(state, work, model, b, centres(work), [&](std::size_t i, NodalVector<Dim> r, std::uint32_t piece) {
    const NodalVector<Dim> m = splat_as<NodalVector<Dim>>(nodes.momentum[i][Dim]);
    const NodalVector<Dim> v = read == ReadVelocity::motion ? leading<Dim>(nodes.motion[i].r[0]) : nodes.velocity[i];
    sums.of(piece)[0].add(m * r - nodes.arm[i], v);
  });
}

}  // namespace crampon
