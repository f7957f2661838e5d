#pragma once
/// How the body of a velocity field turns as a whole (docs/decisions/0020-rotation.md).

#include <array>
#include <cstdint>
#include <vector>

#include "crampon/core/pack.hpp"
#include "crampon/state/rigid.hpp"

namespace crampon {

/// Sum of r x u over pairs of vectors.
template <int Dim>
class CrossSum {
 public:
  [[gnu::always_inline]] void add(NodalVector<Dim> r, NodalVector<Dim> u) {
    if constexpr (Dim == 2) {
      sum_ = fused(r, __builtin_shufflevector(u, u, 1, 0), sum_);
    } else {
      sum_ = fused(r, __builtin_shufflevector(u, u, 1, 2, 0, 3), sum_);
      sum_ = fused(-__builtin_shufflevector(r, r, 1, 2, 0, 3), u, sum_);
    }
  }
  Vec<3> total() const {
    if constexpr (Dim == 2) {
      return {{0., 0., sum_[0] - sum_[1]}};
    } else {
      return {{sum_[1], sum_[2], sum_[0]}};
    }
  }

 private:
  NodalVector<Dim> sum_{};
};

/// w x r of a spin w.
template <int Dim>
class SpinProduct {
 public:
  SpinProduct() = default;
  explicit SpinProduct(const Spin& w) {
    if constexpr (Dim == 2) {
      w_[0] = Pair{-w[2], w[2]};
    } else {
      w_[0] = Pack{w[1], w[2], w[0], 0.};
      w_[1] = Pack{w[2], w[0], w[1], 0.};
    }
  }
  [[gnu::always_inline]] NodalVector<Dim> operator()(NodalVector<Dim> r) const {
    if constexpr (Dim == 2) {
      return w_[0] * __builtin_shufflevector(r, r, 1, 0);
    } else {
      return w_[0] * __builtin_shufflevector(r, r, 2, 0, 1, 3) - w_[1] * __builtin_shufflevector(r, r, 1, 2, 0, 3);
    }
  }

 private:
  NodalVector<Dim> w_[Dim - 1];
};

template <int Dim>
inline NodalVector<Dim> as_nodal(const Vec<Dim>& a) {
  NodalVector<Dim> out = splat_as<NodalVector<Dim>>(0.);
  for (int k = 0; k < Dim; ++k) out[k] = a[static_cast<std::size_t>(k)];
  return out;
}

/// No piece: momenta are those of N03 Eq. 26 alone.
inline constexpr std::uint32_t no_piece = 0xffffffffu;
/// Of a field: particles say of which piece they are. Of a node: it sees particles of several, and has no part in the rotation of any.
inline constexpr std::uint32_t several_pieces = 0xfffffffeu;

/// A piece of material: particles that hang together at the start, without a crack between, in one material field or in several that are
/// bonded to each other.
template <int Dim>
struct Piece {
  std::array<bool, 3> about{};  ///< the axes about which it may turn: those that no symmetry plane forbids
  Vec<Dim> origin;              ///< of first moments: the centre of its field at the start, m

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [about, origin] = self;
    visit(Member{"about"}, about);
    visit(Member{"origin", "m"}, origin);
  }
};

/// All pieces: found before the first step, and kept.
template <int Dim>
struct Pieces {
  std::vector<Piece<Dim>> list;
  std::vector<std::uint32_t> of_field;     ///< per material field
  std::vector<std::uint32_t> of_particle;  ///< by number of the particle; empty where no field has several pieces

  bool any() const { return !list.empty(); }
  bool several() const { return !of_particle.empty(); }
  std::uint32_t in_field(std::size_t field) const { return any() ? of_field[field] : no_piece; }

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [list, of_field, of_particle] = self;
    visit(Member{"list"}, list);
    visit(Member{"of_field"}, of_field);
    visit(Member{"of_particle"}, of_particle);
  }
};

/// How a piece turns in one step.
template <int Dim>
struct PieceRotation {
  Vec<Dim> centre;                          ///< of mass, m
  std::array<Vec<3>, 3> inverse_inertia{};  ///< about the centre, rows, 1/(kg m2)
  Spin spin;                                ///< of its particles as if they were rigid, at the start of the step, rad/s
  Spin spin_end;                            ///< of the velocities that Task 6 extrapolates, rad/s
  Spin spin_term;                           ///< of particles that have the present term of a series for velocities, rad/s
  Spin acceleration;                        ///< by which particles take up the couple of the nodes, rad/s2

  /// The rotation that has an angular momentum, kg m2/s, about the centre.
  Spin rotation_of(const Vec<3>& moment) const {
    return {{dot(inverse_inertia[0], moment), dot(inverse_inertia[1], moment), dot(inverse_inertia[2], moment)}};
  }
};

/// Of which piece the particles about a node are; adds up over tiles.
struct PieceMark {
  std::uint32_t piece = no_piece;
  PieceMark& operator+=(const PieceMark& b) {
    if (piece == no_piece) {
      piece = b.piece;
    } else if (b.piece != no_piece && b.piece != piece) {
      piece = several_pieces;
    }
    return *this;
  }
};

/// What the particles of a block have of a piece, moments about its origin.
struct RotationSums {
  std::uint32_t piece = 0;
  bool held = false;                ///< some have pairs that are folded at faces of prescribed velocity
  double mass = 0;                  ///< kg
  Vec<3> first, momentum, angular;  ///< sums of m x, kg m; m v, kg m/s; x cross m v, kg m2/s
  Vec<3> squares, products;         ///< of {m x x, m y y, m z z} and {m x y, m y z, m z x}, kg m2
};

/// What the nodes of a block do to the rotation of a piece.
struct RotationCouple {
  std::uint32_t piece = 0;
  Vec<3> couple;  ///< sum of arms cross accelerations, N m
  Vec<3> torque;  ///< of all forces about the centre, N m
  Vec<3> read;    ///< angular momentum of particles that take the velocities of nodes, kg m2/s
};

}  // namespace crampon
