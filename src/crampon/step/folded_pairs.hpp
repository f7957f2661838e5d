#pragma once
/// Pairs of a particle and a node that lies beyond a symmetry plane (conventions 29) or beyond a face of prescribed velocity. The particle
/// exchanges with the mirror node instead: what it would read beyond is v_beyond = flip v + offset.

#include <cmath>
#include <cstdlib>
#include <vector>

#include "crampon/step/held_nodes.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// A pair as folds leave it.
template <int Dim>
struct FoldedPair {
  IndexVector<Dim> node{};                ///< in the grid
  Vec<Dim> x_i;                           ///< where it lies, m
  unsigned mirrored = 0;                  ///< bit k: it is on the other side of a plane across axis k
  unsigned flip = 0;                      ///< bit k: component k changes sign
  Vec<Dim> offset_start, offset_end;      ///< m/s, at the start and the end of the step
  std::array<std::uint16_t, Dim> by{};    ///< the condition that changed the sign last
  bool held = false;                      ///< folded at a face of prescribed velocity
  const SymmetryPlane* mirror = nullptr;  ///< the plane, when one symmetry plane is all there is

  bool folded() const { return mirrored != 0; }
};

template <int Dim, class Shape>
class PairFolder {
 public:
  /// \param held  of the block; what rigid bodies pass through: without any
  PairFolder(const Model<Dim>& model, const HeldNodes<Dim, Shape>& held) : model_(model), held_(held) {}

  FoldedPair<Dim> fold(const Vec<Dim>& x_p, const IndexVector<Dim>& node, bool sees_held_faces) const {
    FoldedPair<Dim> pair;
    pair.node = node;
    pair.x_i = model_.grid.node_position(node);
    for (const SymmetryPlane& plane : model_.symmetries) {
      const auto axis = static_cast<std::size_t>(plane.axis);
      if (pair.mirrored >> plane.axis & 1u || !folds<Dim>(plane, x_p, pair.x_i)) continue;
      const int on = static_cast<int>(std::lround((plane.at - model_.grid.origin[axis]) * model_.grid.inverse_cell[axis]));
      // Two beyond it see only particles on the plane itself, at the very end of the reach of a cubic spline, where a node has no weight.
      if (std::abs(pair.node[axis] - on) > 1) continue;
      pair.mirror = pair.folded() ? nullptr : &plane;
      turn(pair, plane.axis, on);
      flip(pair, plane.axis, plane.condition, 0, 0);
    }
    if (sees_held_faces && held_.any()) {
      for (int axis = 0; axis < Dim; ++axis) fold_at_held_face(x_p, axis, pair);
    }
    return pair;
  }

 private:
  void turn(FoldedPair<Dim>& pair, int axis, int on) const {
    const auto k = static_cast<std::size_t>(axis);
    pair.node[k] = 2 * on - pair.node[k];
    pair.x_i[k] = model_.grid.node_coordinate(axis, pair.node[k]);
    pair.mirrored |= 1u << axis;
  }
  /// From here on component `axis` is read as 2 V less what the mirror node has.
  static void flip(FoldedPair<Dim>& pair, int axis, std::uint16_t condition, double start, double end) {
    const auto k = static_cast<std::size_t>(axis);
    const double sign = pair.flip >> axis & 1u ? -1. : 1.;
    pair.offset_start[k] += 2 * sign * start;
    pair.offset_end[k] += 2 * sign * end;
    pair.flip ^= 1u << axis;
    pair.by[k] = condition;
  }

  /// The row of nodes between the node and the particle holds the face when it holds the component across; then all that it holds is
  /// reflected about its velocity. Not where node and mirror node are held themselves.
  void fold_at_held_face(const Vec<Dim>& x_p, int axis, FoldedPair<Dim>& pair) const {
    const auto k = static_cast<std::size_t>(axis);
    if (pair.mirrored >> axis & 1u) return;
    const int towards = x_p[k] > pair.x_i[k] ? 1 : -1;
    IndexVector<Dim> face = pair.node;
    face[k] += towards;
    const double beyond = towards * (x_p[k] - model_.grid.node_coordinate(axis, face[k]));
    if (beyond < 0 || (beyond == 0 && towards < 0)) return;  // a particle on the face is above it
    IndexVector<Dim> mirror = face;
    mirror[k] += towards;
    if ((held_.axes(pair.node) & held_.axes(mirror)) >> axis & 1u) return;
    if (!(held_.axes(face) >> axis & 1u) && !step_onto_face(x_p, axis, face)) return;
    turn(pair, axis, face[k]);
    pair.mirror = nullptr;
    pair.held = true;
    held_.for_components(face, [&](const auto& c) { flip(pair, c.axis, c.condition, c.start, c.end); });
  }

  /// Beside the last node of a held row the face goes on as it ends, for particles that are before the row itself. A row seen edge-on is none.
  bool step_onto_face(const Vec<Dim>& x_p, int axis, IndexVector<Dim>& face) const {
    for (int along = 0; along < Dim; ++along) {
      if (along == axis) continue;
      const auto k = static_cast<std::size_t>(along);
      const int towards = x_p[k] > model_.grid.node_coordinate(along, face[k]) ? 1 : -1;
      IndexVector<Dim> last = face, next = face;
      last[k] += towards;
      next[k] += 2 * towards;
      const bool before_row = towards * (x_p[k] - model_.grid.node_coordinate(along, last[k])) >= 0;
      if (!before_row || !((held_.axes(last) & held_.axes(next)) >> axis & 1u)) continue;
      face = last;
      return true;
    }
    return false;
  }

  const Model<Dim>& model_;
  const HeldNodes<Dim, Shape>& held_;
};

/// The packs of a block with folded pairs, ascending.
template <int Dim, class Shape>
std::vector<std::uint32_t> folded_packs(const State<Dim>& state, const StepWork<Dim>& work, std::size_t b) {
  constexpr std::size_t pairs = std::size_t{lanes} * Tile<Dim, Shape>::stencil;
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  std::vector<std::uint32_t> packs;
  for (std::size_t k = 0; k < layers.targets_of_pack.size(); ++k) {
    if (layers.targets_of_pack[k] < 0) continue;
    const PairTarget* first = &layers.targets[static_cast<std::size_t>(layers.targets_of_pack[k]) * pairs];
    if (std::any_of(first, first + pairs, [](const PairTarget& t) { return t.mirrored != 0; }))
      packs.push_back(state.order.runs[work.blocks.list[b].first_run].first_pack + static_cast<std::uint32_t>(k));
  }
  return packs;
}

}  // namespace crampon
