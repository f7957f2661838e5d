#include "crampon/step/rotation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/transfer.hpp"

namespace crampon {

namespace {

constexpr std::array<std::size_t, 3> next_axis{1, 2, 0};

/// The rows of the inverse of a moment of inertia about the axes that are free; all zero where particles have no extent across one of them. smallest: a
/// trace below that, kg m2, is round-off of sums over one particle.
std::array<Vec<3>, 3> inverse_of(Eigen::Matrix3d inertia, const std::array<bool, 3>& about, double smallest) {
  const double size = inertia.trace();
  for (int k = 0; k < 3; ++k) {
    if (about[static_cast<std::size_t>(k)]) continue;
    inertia.row(k).setZero();
    inertia.col(k).setZero();
    inertia(k, k) = size;
  }
  std::array<Vec<3>, 3> out{};
  if (!(size > smallest)) return out;
  if (!(inertia.determinant() > 1e-12 * size * size * size)) return out;
  const Eigen::Matrix3d inverse = inertia.inverse();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
      if (about[row] && about[column]) out[row][column] = inverse(i, j);
    }
  }
  return out;
}

Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// Moment of inertia about the origin less that of the mass m at the distance c from it.
Eigen::Matrix3d inertia_about_centre(const Vec<3>& squares, const Vec<3>& products, double m, const Vec<3>& c) {
  Eigen::Matrix3d J;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = next_axis[k], j = next_axis[i];
    const auto r = static_cast<int>(k), s = static_cast<int>(i);
    J(r, r) = squares[i] + squares[j] - m * (c[i] * c[i] + c[j] * c[j]);
    J(r, s) = J(s, r) = -(products[k] - m * c[k] * c[i]);
  }
  return J;
}

/// f(slot, from a point to the node) for the own nodes of a block in a layer.
template <int Dim, class F>
void for_own_nodes(const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, std::size_t layer, const Vec<Dim>& point, F f) {
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
void for_turning_nodes(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, Point point_of, F f) {
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
RotationCouple& couple_of(std::vector<RotationCouple>& couples, std::uint32_t piece) {
  const auto at = std::find_if(couples.begin(), couples.end(), [&](const RotationCouple& c) { return c.piece == piece; });
  if (at != couples.end()) return *at;
  couples.push_back({piece, {}, {}, {}});
  return couples.back();
}

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

}  // namespace

template <int Dim>
void find_rotations(State<Dim>& state, StepWork<Dim>& work) {
  std::vector<RotationSums> total(state.pieces.list.size());
  work.rotations.resize(total.size());
  for (const BlockScratch<Dim>& scratch : work.scratch) {
    for (const RotationSums& part : scratch.rotation) {
      RotationSums& sum = total[part.piece];
      sum.held = sum.held || part.held;
      sum.mass += part.mass;
      sum.first += part.first;
      sum.momentum += part.momentum;
      sum.angular += part.angular;
      sum.squares += part.squares;
      sum.products += part.products;
    }
  }
  for (std::size_t i = 0; i < total.size(); ++i) {
    const Piece<Dim>& piece = state.pieces.list[i];
    PieceRotation<Dim>& rotation = work.rotations[i];
    const RotationSums& sum = total[i];
    rotation.inverse_inertia = {};
    rotation.spin = {};
    if (sum.held || !(sum.mass > 0)) continue;
    const Vec<3> to_centre = sum.first * (1 / sum.mass);
    rotation.centre = piece.origin;
    for (std::size_t k = 0; k < Dim; ++k) rotation.centre[k] += to_centre[k];
    rotation.inverse_inertia = inverse_of(inertia_about_centre(sum.squares, sum.products, sum.mass, to_centre), piece.about,
                                          1e-12 * (sum.squares[0] + sum.squares[1] + sum.squares[2]));
    rotation.spin = rotation.rotation_of(sum.angular - cross(to_centre, sum.momentum));
  }
}

template <int Dim, class Shape>
void assemble_arms(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  Nodes<Dim>& nodes = work.nodes;
  const BlockLayers<Dim>& layers = nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    const std::uint32_t piece = state.pieces.in_field(layers.node[l].field);
    if (piece == no_piece) continue;
    assemble_layer<Dim, Shape>(work, b, layers.node[l], nodes.tile_moment, &nodes.arm[layers.slot(l, 0)]);
    if (piece == several_pieces) assemble_layer<Dim, Shape>(work, b, layers.node[l], nodes.tile_piece, &nodes.piece[layers.slot(l, 0)]);
  }
  const auto origin_of = [&](std::uint32_t piece) { return state.pieces.list[piece].origin; };
  for_turning_nodes(state, work, model, b, origin_of, [&](std::size_t i, NodalVector<Dim> r, std::uint32_t) {
    nodes.arm[i] = splat_as<NodalVector<Dim>>(nodes.momentum[i][Dim]) * r - nodes.arm[i];
  });
}

template <int Dim>
void carry_rotation(State<Dim>& state, StepWork<Dim>& work, std::size_t b, Spin PieceRotation<Dim>::*spin, double ahead) {
  const NodalVector<Dim> s = splat_as<NodalVector<Dim>>(ahead);
  const auto carried = [&](const SpinProduct<Dim>& turned, NodalVector<Dim> arm) {
    const NodalVector<Dim> once = turned(arm);
    return as_record<Dim>(fused(s, turned(once), once));
  };
  const BlockLayers<Dim>& layers = work.nodes.layers[b];
  const Pieces<Dim>& pieces = state.pieces;
  const NodalVector<Dim>* arm = work.nodes.arm.data();
  Pack* momentum = work.nodes.momentum.data();
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

namespace {

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

}  // namespace

template <int Dim>
void sum_couples(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const Nodes<Dim>& nodes = work.nodes;
  std::vector<RotationCouple>& couples = work.scratch[b].couples;
  couples.clear();
  const auto hand_over = [](RotationCouple& c, const auto& sums) { c.couple += sums[0].total(), c.torque += sums[1].total(); };
  SumsOfPieces<Dim, 2, decltype(hand_over)> sums(couples, hand_over);
  for_turning_nodes(state, work, model, b, centres(work), [&](std::size_t i, NodalVector<Dim> r, std::uint32_t piece) {
    const NodalVector<Dim> a = acceleration(nodes.motion[i]);
    auto& [couple, torque] = sums.of(piece);
    couple.add(nodes.arm[i], a);
    torque.add(splat_as<NodalVector<Dim>>(nodes.momentum[i][Dim]) * r, a);
  });
}

namespace {

enum class ReadVelocity { motion, term };
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

}  // namespace

template <int Dim>
void sum_rotation_of_motion(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  sum_read_rotation(state, work, model, b, ReadVelocity::motion);
}
template <int Dim>
void sum_rotation_of_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  sum_read_rotation(state, work, model, b, ReadVelocity::term);
}

template <int Dim>
void answer_couples(State<Dim>& state, StepWork<Dim>& work) {
  const VelocityRule& rule = work.now.rule;
  const std::vector<RotationCouple> total = total_couples(state, work);
  for (std::size_t i = 0; i < total.size(); ++i) {
    PieceRotation<Dim>& rotation = work.rotations[i];
    const RotationCouple& sum = total[i];
    rotation.acceleration = rotation.rotation_of(sum.couple);
    rotation.spin_end = rotation.spin * (rule.own - rule.damped) + rotation.rotation_of(sum.read * rule.nodal + sum.torque * rule.gain) -
                        rotation.acceleration * (rule.damped * rule.dt);
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

template <int Dim>
void find_term_spins(State<Dim>& state, StepWork<Dim>& work) {
  const std::vector<RotationCouple> total = total_couples(state, work);
  for (std::size_t i = 0; i < total.size(); ++i) {
    work.rotations[i].spin_term = work.rotations[i].rotation_of(total[i].read);
  }
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                   \
  template void find_rotations<DIM>(State<DIM>&, StepWork<DIM>&);                                                  \
  template void carry_rotation<DIM>(State<DIM>&, StepWork<DIM>&, std::size_t, Spin PieceRotation<DIM>::*, double); \
  template void sum_couples<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);                     \
  template void sum_rotation_of_motion<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);          \
  template void sum_rotation_of_term<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);            \
  template void answer_couples<DIM>(State<DIM>&, StepWork<DIM>&);                                                  \
  template void take_up_couples<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t, double);         \
  template void find_term_spins<DIM>(State<DIM>&, StepWork<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void assemble_arms<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
