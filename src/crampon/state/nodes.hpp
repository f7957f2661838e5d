#pragma once
/// What lives on nodes and tiles during one step. Nothing here survives a step but the contact memory (state/contact_memory.hpp).

#include <concepts>
#include <cstdint>
#include <vector>

#include "crampon/core/aligned_array.hpp"
#include "crampon/core/pack.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/state/blocks.hpp"
#include "crampon/state/layers.hpp"
#include "crampon/state/particles.hpp"
#include "crampon/state/rotation.hpp"

namespace crampon {

/// {v', a} of Task 4, what particles read in Task 5: one Pack in 2D, two in 3D.
template <int Dim>
struct MotionRecord {
  Pack r[motion_packs<Dim>];
};

template <int Dim>
inline NodalVector<Dim> acceleration(const MotionRecord<Dim>& motion) {
  if constexpr (Dim == 2) {
    return Pair{motion.r[0][2], motion.r[0][3]};
  } else {
    return motion.r[1];
  }
}

/// Sums behind contact at a node, per layer: {V, m(x - x_i)}, {grad V, m(X - x_i)} (N03 Eq. 8, N13 sec. 3 step 1); in 2D V is the area, m2,
/// and two packs hold all: {V, m x, m y, dV/dx}, {dV/dy, m X, m Y, m c}. In 3D {V, m x}, {m c, m X}, {grad V, 0}. c is what a particle
/// remembers of contact.
template <int Dim>
struct ContactSums {
  Pack r[Dim == 2 ? 2 : 3];

  double volume() const { return r[0][0]; }
  Vec<Dim> present() const { return three(r[0]); }   ///< sum of m (x - x_i), kg m
  Vec<Dim> original() const { return three(r[1]); }  ///< sum of m (X - x_i), kg m
  double history() const { return Dim == 2 ? r[1][3] : r[1][0]; }
  Vec<Dim> gradient() const {  ///< sum of V_p G_ip: out of the material
    Vec<Dim> g;
    if constexpr (Dim == 2) {
      g[0] = r[0][3], g[1] = r[1][0];
    } else {
      for (int k = 0; k < 3; ++k) g[k] = r[2][k];
    }
    return g;
  }

 private:
  static Vec<Dim> three(Pack a) {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = a[1 + k];
    return x;
  }
};

/// Sums over the pairs that cross one crack, per node: present normals n, original normals N (unit vectors, conventions 9), sides (conventions
/// 17) and how many pairs there are. In 2D {n, side, count}, {N, 0, 0}; in 3D {n, side}, {N, count}.
struct CrossingSums {
  Pack r[2];

  /// Of one pair.
  template <int Dim>
  static CrossingSums of_pair(const Vec<Dim>& n, const Vec<Dim>& N, int side) {
    if constexpr (Dim == 2) {
      return {{Pack{n[0], n[1], double(side), 1.}, Pack{N[0], N[1], 0., 0.}}};
    } else {
      return {{Pack{n[0], n[1], n[2], double(side)}, Pack{N[0], N[1], N[2], 1.}}};
    }
  }
  template <int Dim>
  Vec<Dim> normals() const {
    return first<Dim>(r[0]);
  }
  template <int Dim>
  Vec<Dim> original_normals() const {
    return first<Dim>(r[1]);
  }
  template <int Dim>
  double side() const {
    return r[0][Dim];
  }
  template <int Dim>
  double count() const {
    return Dim == 2 ? r[0][3] : r[1][3];
  }

 private:
  template <int Dim>
  static Vec<Dim> first(Pack a) {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = a[k];
    return x;
  }
};

/// Offsets of velocities in folded pairs: twice what the face between has (step/folded_pairs.hpp; 0 at symmetry planes). Entry 0 is zero.
template <int Dim>
struct PairOffsets {
  std::vector<Pack> start = {splat(0.)}, end = {splat(0.)};       ///< m/s, at the start and the end of the step
  std::vector<MotionRecord<Dim>> motion = {MotionRecord<Dim>{}};  ///< as {v', a} has it

  bool any() const { return start.size() > 1; }
  void clear() {
    start.resize(1);
    end.resize(1);
    motion.resize(1);
  }
};

/// The layers of one block, as a tile sees them and as the block's own nodes see them.
template <int Dim>
struct BlockLayers {
  std::vector<Layer> tile{Layer{}};               ///< layers in which the block's particles take part, ascending
  std::vector<TileBox<Dim>> tile_box{{}};         ///< box touched by each tile layer that is beyond a crack
  std::vector<std::uint8_t> run_layer;            ///< per run of the block: layer of pairs that cross nothing; empty: 0
  std::vector<Layer> node{Layer{}};               ///< layers present at the block's own nodes, ascending
  std::vector<CrackId> tile_cracks, node_cracks;  ///< cracks crossed by pairs of the tile / at own nodes
  std::vector<PairTarget> targets;                ///< [pack with targets][lane][stencil node]
  PairOffsets<Dim> offsets;
  std::vector<std::int32_t> targets_of_pack;     ///< per pack of the block: which of `targets` are its, or -1; empty: none has any
  std::uint32_t tile_begin = 0, node_begin = 0;  ///< first tile / nodal slot
  std::uint32_t crossing_tile_begin = 0, crossing_node_begin = 0;
  std::vector<std::uint8_t> shared;          ///< per own node: holds several fields or is near a rigid face; empty: none
  std::vector<std::uint32_t> contact_packs;  ///< of the block's particles: with a part in shared nodes, ascending
  bool near_face = false;                    ///< own nodes within reach of a rigid face
  bool sums_contact = false;                 ///< some node in reach has several layers or is near a rigid face

  /// Index into the nodal arrays of node n in layer l.
  std::size_t slot(std::integral auto l, std::integral auto n) const {
    return (node_begin + static_cast<std::size_t>(l)) * block_nodes<Dim> + static_cast<std::size_t>(n);
  }
};

/// What one step keeps for each node of each velocity field: records of one kind. Each block puts the parts of its particles on tiles of its own,
/// assembly adds tiles up at nodes (step/assemble.hpp), and particles read what is gathered from nodes (step/tile_buffer.hpp).
template <class Record>
struct NodalRecords {
  AlignedArray<Record> tiles;  ///< [slot of a tile][tile node]; empty where particles give nothing
  AlignedArray<Record> nodes;  ///< [slot][own node]

  Record& operator[](std::size_t i) { return nodes[i]; }
  const Record& operator[](std::size_t i) const { return nodes[i]; }
  std::size_t bytes() const { return tiles.bytes() + nodes.bytes(); }
};

/// All nodal quantities of a step. A slot is a (block, layer).
template <int Dim>
struct Nodes {
  std::vector<BlockLayers<Dim>> layers;  ///< per block
  std::size_t tile_slots = 0, node_slots = 0, crossing_tile_slots = 0, crossing_node_slots = 0;

  NodalRecords<Pack> momentum;              ///< {p, m} with the mass in lane Dim: kg m/s, kg
  NodalRecords<NodalVector<Dim>> arm;       ///< tiles: sum of m x_p, kg m; nodes: sum of m (x_i - x_p); where rotation is carried
  NodalRecords<PieceMark> piece;            ///< whose rotation the node has a part in, where fields have several pieces
  NodalRecords<NodalVector<Dim>> force;     ///< N
  NodalRecords<NodalVector<Dim>> velocity;  ///< what the next stress update reads, m/s
  NodalRecords<MotionRecord<Dim>> motion;   ///< {v', a} of Task 4
  NodalRecords<ContactSums<Dim>> contact;
  NodalRecords<Pack> contact_gain;  ///< after Task 4: {what particles add to their memory of contact, 1} in contact, else 0
  NodalRecords<CrossingSums> crossing;

  /// f(records) for each kind. The first line binds all members, so that one that is not named here does not compile.
  template <class Self, class F>
  static void for_records(Self& self, F f) {
    auto& [layers, tile_slots, node_slots, crossing_tile_slots, crossing_node_slots, momentum, arm, piece, force, velocity, motion, contact,
           contact_gain, crossing] = self;
    const auto visit = [&](auto&... records) { (f(records), ...); };
    visit(momentum, arm, piece, force, velocity, motion, contact, contact_gain, crossing);
  }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for_records(*this, [&](const auto& records) { sum += records.bytes(); });
    return sum;
  }
};

}  // namespace crampon
