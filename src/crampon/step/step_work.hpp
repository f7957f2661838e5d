#pragma once
/// What one step works with.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "crampon/contact/face_contact.hpp"
#include "crampon/contact/node_solve.hpp"
#include "crampon/state/blocks.hpp"
#include "crampon/state/nodes.hpp"
#include "crampon/state/state.hpp"
#include "crampon/step/crack_view.hpp"
#include "crampon/step/tip_watch.hpp"
#include "crampon/step/transfer.hpp"

namespace crampon {

/// A prescribed component of a node. Rebuilt when blocks change.
struct FixedComponent {
  std::uint16_t node = 0;  ///< local node of the block
  std::uint8_t axis = 0;
  std::uint16_t condition = 0;
  std::uint16_t component = 0;    ///< of the condition
  bool active = false;            ///< the condition holds in this step
  bool newly_prescribed = false;  ///< ... and the component was free in the step before
  double v_old = 0, v_new = 0;    ///< m/s, at the start and the end of the step
};

/// A particle that a force acts on. Rebuilt when blocks change.
struct LoadedParticle {
  std::uint32_t slot = 0;
  std::uint32_t load = 0, entry = 0;
};

/// A particle behind a face under load. Rebuilt when blocks change.
struct FaceParticle {
  std::uint32_t slot = 0;
  std::uint32_t number = 0;  ///< index into LoadedFaces::particles
};

/// Faces under load in this step.
template <int Dim>
struct FaceStates {
  std::vector<std::array<double, Dim * Dim>> deformation;  ///< per particle: F[d * Dim + k]
  std::vector<double> sum;                                 ///< per link: of its weights over all nodes, m2
  std::vector<Vec<Dim>> traction;                          ///< per column, Pa of the undeformed area
  std::vector<double> rest;                                ///< per column: what a link's sum lacks of its part of the area, m2
  std::vector<bool> present;                               ///< per particle: not removed on leaving the grid
};

/// Sums of one block over one step; added up in block order, so that they do not depend on threads.
template <int Dim>
struct BlockLedger {
  double load_work = 0, body_work = 0, damping = 0, contact_loss = 0, friction_loss = 0, boundary_work = 0;  ///< J
  double transfer_loss = 0;  ///< what particles lose by taking velocities from nodes, J
  struct Reaction {
    std::uint16_t condition;
    Vec<Dim> force;
  };
  double interface_energy = 0;      ///< in interfaces at the end of the step, J
  std::vector<Reaction> reactions;  ///< N
  struct BodyReaction {
    std::uint16_t body;
    RigidReaction<Dim> on_material;
  };
  std::vector<BodyReaction> rigid;
  int unsolved_nodes = 0;  ///< contact at a node did not converge
  int crowded_nodes = 0;   ///< nodes with more than two cracks
  void add_reaction(std::uint16_t condition, int axis, double force) {
    auto at = std::find_if(reactions.begin(), reactions.end(), [&](const Reaction& r) { return r.condition == condition; });
    if (at == reactions.end()) at = reactions.insert(reactions.end(), {condition, {}});
    at->force[axis] += force;
  }
  void clear() {
    interface_energy = load_work = body_work = damping = contact_loss = friction_loss = boundary_work = transfer_loss = 0;
    reactions.clear();
    rigid.clear();
    unsolved_nodes = crowded_nodes = 0;
  }
};

/// What went wrong in a block during particle work.
struct BlockHealth {
  bool left_margin = false;  ///< a particle left the block's margin: re-order before the next step
  bool bad_number = false;
  bool inverted = false;
  bool moved_too_far = false;  ///< more than a cell in a step
  bool left_grid = false;
  bool trouble() const { return bad_number || inverted || moved_too_far || left_grid; }
};

/// A force on a node in one field.
template <int Dim>
struct NodalForce {
  std::size_t slot = 0;  ///< in the nodal arrays
  Vec<Dim> force;        ///< N
};

/// Per block, per step: what belongs to nodes with conditions or contact.
template <int Dim>
struct BlockScratch {
  std::vector<FixedComponent> fixed;
  std::vector<double> p_int;             ///< [layer][fixed]: momentum before the boundary condition (N13 sec. 2.3)
  std::vector<LoadedParticle> loaded;    ///< by slot
  std::vector<FaceParticle> faces;       ///< by slot
  AlignedArray<NodalVector<Dim>> loads;  ///< forces of loads on the tile, all layers, N; only where there are any
  std::vector<NodalForce<Dim>> tractions;
  ContactNodes<Dim> contact;
  FaceNodes<Dim> face_nodes;
  std::vector<RotationSums> rotation;   ///< per piece of its particles, in the order of runs
  std::vector<RotationCouple> couples;  ///< per piece at its nodes
  BlockLedger<Dim> ledger;
  BlockHealth health;
};

/// Where particles stand now; filled when loads or cracks ask for it.
struct ParticlePlaces {
  std::vector<std::uint32_t> slot_of_id;  ///< padding_id: removed on leaving the grid
  std::vector<std::uint32_t> block_of_pack;
};

struct Phase {
  std::string name;
  double seconds = 0;
};

/// What holds for the whole of a step: set before its first stage (step/advance.cpp), and what is prescribed by the stage "prescribe".
struct StepValues {
  double dt = 0;                ///< s
  double lead = 0;              ///< of positions before the time of the step, s
  double further = 0;           ///< by which they lead more than in the last step, s
  double stress_dt = 0;         ///< over which a stress update of the step strains, s
  bool watched = false;         ///< someone will look at the state after the step
  bool growth_due = false;      ///< tips may grow
  bool nucleation_due = false;  ///< cracks may start
  bool fracture_due = false;    ///< fracture parameters are found at its end
  StepTransfer transfer;
  VelocityRule rule;
  int term = 1;  ///< of the series of a transfer
};

/// What one step prescribes.
template <int Dim>
struct Prescribed {
  std::vector<Vec<Dim>> loads;  ///< per load, N per share or Pa
  Vec<Dim> body_force;          ///< m/s2
  double damping = 0;           ///< of nodes, 1/s
  double particle_damping = 0;  ///< 1/s
};

/// All that a step finds anew: blocks, velocity fields, nodes, tiles, contacts. Nothing here outlives the step but what follows from the order of
/// particles (blocks, places, conditions of blocks), which re-ordering and loading build.
template <int Dim>
struct StepWork {
  Blocks<Dim> blocks;
  ParticlePlaces places;
  CrackView<Dim> crack_view;
  std::vector<TipWatch> tips;  ///< per tip of State::fracture, in steps that find fracture parameters
  Nodes<Dim> nodes;
  std::vector<BlockScratch<Dim>> scratch;  ///< per block
  FaceContacts<Dim> face_contacts;
  FaceStates<Dim> faces;
  std::vector<PieceRotation<Dim>> rotations;  ///< per piece
  StepValues now;
  Prescribed<Dim> prescribed;
  std::vector<Phase> phases;  ///< wall time since the start

  StepWork() = default;
  StepWork(StepWork&&) noexcept = default;
  StepWork& operator=(StepWork&&) noexcept = default;
  StepWork(const StepWork&) = delete;  // meshes of cracks are views into it
  StepWork& operator=(const StepWork&) = delete;
};

}  // namespace crampon
