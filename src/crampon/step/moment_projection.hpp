#pragma once
/// First moments of particles about nodes, and the sums behind the rotation of pieces of material (step/rotation.hpp): beside Task 1.

#include <algorithm>
#include <vector>

#include "crampon/step/packs.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

/// Of the particles of one block: tiles of sum_p S_ip m_p (x_p - origin), kg m, and RotationSums of each piece.
template <int Dim, class Shape>
class MomentProjection {
  using T = Tile<Dim, Shape>;

 public:
  MomentProjection(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b)
      : particles_(state.particles),
        model_(model),
        pieces_(state.pieces),
        first_(work.blocks.list[b].first_node()),
        sums_(work.scratch[b].rotation) {
    sums_.clear();
    if (pieces_.any()) tiles_ = cleared_tiles<Dim, Shape>(work, b, work.nodes.arm);
    if (pieces_.several()) marks_ = cleared_tiles<Dim, Shape>(work, b, work.nodes.piece);
  }

  /// \param m  masses of the pack, kg
  [[gnu::always_inline]] void add(std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run,
                                  const Pack& m) {
    if (!tiles_) return;
    if (&run != run_) enter(run);
    if (piece_ == no_piece) return;
    NodalVector<Dim> moment[lanes];
    for (int l = 0; l < lanes; ++l) {
      const Pack& x = particles_.motion[(std::size_t{pack} * lanes + l) * motion_packs<Dim>];
      moment[l] = splat_as<NodalVector<Dim>>(m[l]) * (leading<Dim>(x) - origin_);
    }
    scatter_records<Dim, Shape>(
        stencil, targets, [&](int l, const PairTarget& t) { return t.mirrored == 0 ? moment[l] : folded(moment[l], m[l], t); }, moment,
        tiles_);
    if (piece_ == several_pieces) {
      held_ = false;  // said of each particle
      return add_by_pieces(pack, stencil, targets, m);
    }
    sum_up(pack, m);
  }
  /// Hands over the sums of the last run.
  void finish() {
    if (mass_[0] + mass_[1] + mass_[2] + mass_[3] == 0) return;
    const auto total = [](const Pack& a) { return (a[0] + a[1]) + (a[2] + a[3]); };
    RotationSums& out = sums_of(piece_);
    out.held = out.held || held_;
    held_ = false;
    out.mass += total(mass_);
    for (std::size_t k = 0; k < Dim; ++k) {
      out.first[k] += total(moment_[k]);
      out.momentum[k] += total(momentum_[k]);
      out.squares[k] += total(square_[k]);
    }
    for (std::size_t k = 0; k < planes; ++k) {
      out.angular[Dim == 2 ? 2 : k] += total(angular_[k]);
      out.products[k] += total(product_[k]);
    }
    clear();
  }

 private:
  static constexpr int planes = Dim == 2 ? 1 : 3;  // of rotation

  void enter(const Run& run) {
    finish();
    run_ = &run;
    const std::uint16_t field = model_.materials[run.material].field;
    piece_ = pieces_.in_field(field);
    if (piece_ == several_pieces) {
      origin_ = as_nodal(pieces_.list[pieces_.of_particle[particles_.id[std::size_t{run.first_pack} * lanes]]].origin);
    } else if (piece_ != no_piece) {
      origin_ = as_nodal(pieces_.list[piece_].origin);
    }
  }
  void clear() {
    mass_ = splat(0.);
    for (int k = 0; k < Dim; ++k) moment_[k] = momentum_[k] = square_[k] = splat(0.);
    for (int k = 0; k < planes; ++k) angular_[k] = product_[k] = splat(0.);
  }
  RotationSums& sums_of(std::uint32_t piece) {
    const auto at = std::find_if(sums_.begin(), sums_.end(), [&](const RotationSums& s) { return s.piece == piece; });
    if (at != sums_.end()) return *at;
    sums_.emplace_back().piece = piece;
    return sums_.back();
  }

  /// Lanes over particles.
  [[gnu::always_inline]] void sum_up(std::uint32_t pack, const Pack& m) {
    Pack x[3], v[3];
    particles_.pack_positions(pack, x);
    particles_.pack_velocities(pack, v);
    mass_ += m;
    Pack mv[Dim], mx[Dim];
    for (int k = 0; k < Dim; ++k) {
      x[k] -= splat(origin_[k]);
      mx[k] = m * x[k], mv[k] = m * v[k];
      moment_[k] += mx[k];
      momentum_[k] += mv[k];
      square_[k] = fused(mx[k], x[k], square_[k]);
    }
    for (int k = 0; k < planes; ++k) {
      const int i = Dim == 2 ? 0 : (k + 1) % 3, j = Dim == 2 ? 1 : (k + 2) % 3;
      angular_[k] = fused(x[i], mv[j], fused(-x[j], mv[i], angular_[k]));
      const int p = Dim == 2 ? 0 : k, q = Dim == 2 ? 1 : (k + 1) % 3;
      product_[k] = fused(mx[p], x[q], product_[k]);
    }
  }

  /// Where a field has several pieces: one particle after the other, and marks on the nodes.
  [[gnu::noinline]] void add_by_pieces(std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Pack& m) {
    for (int l = 0; l < lanes; ++l) {
      const std::size_t p = std::size_t{pack} * lanes + static_cast<std::size_t>(l);
      if (particles_.is_padding(p)) continue;
      piece_ = pieces_.of_particle[particles_.id[p]];
      Pack one = splat(0.);
      one[l] = m[l];
      sum_up(pack, one);
      for (int n = 0; n < T::stencil; ++n) {
        const PairTarget* t = targets ? &targets[l * T::stencil + n] : nullptr;
        if (stencil.weight(n, l) != 0) marks_[t ? t->layer * T::nodes + t->node : stencil.of.base[l] + T::steps[n]] += PieceMark{piece_};
        held_ = held_ || (t && t->held != 0);
      }
      finish();
    }
    piece_ = several_pieces;
  }

  /// A folded pair has no arm across the plane.
  NodalVector<Dim> folded(NodalVector<Dim> moment, double m, const PairTarget& t) {
    held_ = held_ || t.held != 0;
    const IndexVector<Dim> node = unflatten<Dim>(t.node, T::side);
    for (int k = 0; k < Dim; ++k) {
      if (t.mirrored >> k & 1u) moment[k] = m * (model_.grid.node_coordinate(k, first_[k] + node[k] - T::offset) - origin_[k]);
    }
    return moment;
  }

  const Particles<Dim>& particles_;
  const Model<Dim>& model_;
  const Pieces<Dim>& pieces_;
  IndexVector<Dim> first_;
  std::vector<RotationSums>& sums_;
  NodalVector<Dim>* tiles_ = nullptr;  ///< null: no rotation is carried
  PieceMark* marks_ = nullptr;
  const Run* run_ = nullptr;
  std::uint32_t piece_ = no_piece;
  bool held_ = false;
  NodalVector<Dim> origin_{};
  Pack mass_ = splat(0.), moment_[Dim]{}, momentum_[Dim]{}, square_[Dim]{}, angular_[planes]{}, product_[planes]{};
};

}  // namespace crampon
