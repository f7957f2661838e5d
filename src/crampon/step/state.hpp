#pragma once
/// What changes during a run.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

#include "crampon/contact/face_contact.hpp"
#include "crampon/contact/memory.hpp"
#include "crampon/contact/node_solve.hpp"
#include "crampon/crack/traction/history.hpp"
#include "crampon/state/blocks.hpp"
#include "crampon/state/cracks.hpp"
#include "crampon/state/nodes.hpp"
#include "crampon/state/particles.hpp"
#include "crampon/state/rigid.hpp"
#include "crampon/state/rotation.hpp"
#include "crampon/step/crack_view.hpp"

namespace crampon {

/// A prescribed component of a node. Rebuilt when blocks change.
struct FixedComponent {
  std::uint16_t node = 0;  ///< local node of the block
  std::uint8_t axis = 0;
  std::uint16_t condition = 0;
  std::uint16_t component = 0;  ///< of the condition
  bool active = false;          ///< the condition holds in this step
  bool fresh = false;           ///< ... and the component was free in the step before
  double v_old = 0, v_new = 0;  ///< m/s, at the start and the end of the step
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
  std::vector<Vec<Dim>> area_vector;                       ///< per column: of the deformed face over the undeformed area
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

/// Energy totals since the start, J.
struct EnergyTotals {
  double load_work = 0, body_work = 0, boundary_work = 0, damping = 0, contact_loss = 0, friction_loss = 0, transfer_loss = 0;
  double interfaces = 0;  ///< held by interfaces now
};

/// Sums over particles.
template <int Dim>
struct ParticleSums {
  double mass = 0, kinetic = 0, strain = 0;  ///< kg, J, J
  double dissipated = 0;                     ///< by material laws since the start, J
  Vec<Dim> momentum;                         ///< kg m/s
  double angular = 0;                        ///< z component about the origin, kg m2/s
  ParticleSums& operator+=(const ParticleSums& other) {
    mass += other.mass, kinetic += other.kinetic, strain += other.strain, dissipated += other.dissipated, angular += other.angular;
    momentum += other.momentum;
    return *this;
  }
};

/// A force on a node in one field.
template <int Dim>
struct NodalForce {
  std::size_t slot = 0;  ///< in the nodal arrays
  Vec<Dim> force;        ///< N
};

/// Tractions on one crack, per vertex; empty without a law.
template <int Dim>
struct CrackTractionState {
  std::vector<TractionHistory> history;
  std::vector<Vec<Dim>> force;  ///< on the upper surface in the next step, N
  std::vector<double> stored;   ///< J/m2
  std::vector<bool> between;    ///< there is material on both sides in this step
};

/// All traction laws together, J.
struct CohesiveTotals {
  double stored = 0, dissipated_normal = 0, dissipated_shear = 0;
  double work_of_pressure = 0;  ///< done on the body from outside
};

/// A vertex whose traction law has failed.
template <int Dim>
struct FailureEvent {
  double time = 0;  ///< s
  std::size_t crack = 0;
  Vec<Dim> x;                ///< m
  double G_I = 0, G_II = 0;  ///< dissipated there, J/m2
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

template <int Dim>
struct State {
  double time = 0;
  std::int64_t step = 0;
  Particles<Dim> particles;
  Cracks<Dim> cracks;
  CrackView crack_view;
  Blocks<Dim> blocks;
  ParticlePlaces places;
  Nodes<Dim> nodes;
  std::vector<BlockScratch<Dim>> scratch;  ///< per block
  FaceContacts<Dim> face_contacts;
  ContactMemory memory;
  std::vector<CrackTractionState<Dim>> tractions;  ///< per crack
  FaceStates<Dim> faces;
  CohesiveTotals cohesive;
  double traction_time_step = std::numeric_limits<double>::infinity();        ///< longest that the springs of traction laws bear now, s
  double least_traction_time_step = std::numeric_limits<double>::infinity();  ///< ... since the start
  std::vector<FailureEvent<Dim>> events;                                      ///< since the start
  Rotations<Dim> rotations;
  std::vector<RigidMotion<Dim>> rigid;              ///< per rigid body
  std::vector<RigidReaction<Dim>> rigid_reactions;  ///< per rigid body, last step
  std::vector<std::int64_t> prescribed_by_rigid;    ///< node number * Dim + axis, ascending: last step
  std::vector<bool> condition_was_active;
  std::unordered_map<std::int64_t, double> initial_volume;  ///< by node number: of the uncut body at the start, m2 or m3 (CONVENTIONS 10)
  bool must_reorder = true;
  std::size_t particle_count = 0;
  std::int64_t removed = 0;  ///< particles removed on leaving the grid
  ParticleSums<Dim> left;    ///< what they took along

  EnergyTotals energy;
  std::vector<Vec<Dim>> reactions;  ///< per condition, last step, N
  std::int64_t most_unsolved_nodes = 0, most_crowded_nodes = 0;
  std::vector<Phase> phases;
};

}  // namespace crampon
