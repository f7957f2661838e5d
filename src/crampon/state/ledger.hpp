#pragma once
/// The books of a run: energies since the start, what left, what conditions and loads have met.

#include <cstdint>
#include <limits>
#include <vector>

#include "crampon/core/members.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/state/rigid.hpp"

namespace crampon {

/// Energy totals since the start, J.
struct EnergyTotals {
  double load_work = 0, body_work = 0, boundary_work = 0, damping = 0, contact_loss = 0, friction_loss = 0, transfer_loss = 0;
  double interfaces = 0;  ///< held by interfaces now

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [load_work, body_work, boundary_work, damping, contact_loss, friction_loss, transfer_loss, interfaces] = self;
    visit(Member{"load_work", "J"}, load_work);
    visit(Member{"body_work", "J"}, body_work);
    visit(Member{"boundary_work", "J"}, boundary_work);
    visit(Member{"damping", "J"}, damping);
    visit(Member{"contact_loss", "J"}, contact_loss);
    visit(Member{"friction_loss", "J"}, friction_loss);
    visit(Member{"transfer_loss", "J"}, transfer_loss);
    visit(Member{"interfaces", "J"}, interfaces);
  }
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

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [mass, kinetic, strain, dissipated, momentum, angular] = self;
    visit(Member{"mass", "kg"}, mass);
    visit(Member{"kinetic", "J"}, kinetic);
    visit(Member{"strain", "J"}, strain);
    visit(Member{"dissipated", "J"}, dissipated);
    visit(Member{"momentum", "kg m/s"}, momentum);
    visit(Member{"angular", "kg m2/s"}, angular);
  }
};

/// All traction laws together, J.
struct CohesiveTotals {
  double stored = 0, dissipated_normal = 0, dissipated_shear = 0;
  double work_of_pressure = 0;  ///< done on the body from outside

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [stored, dissipated_normal, dissipated_shear, work_of_pressure] = self;
    visit(Member{"stored", "J"}, stored);
    visit(Member{"dissipated_normal", "J"}, dissipated_normal);
    visit(Member{"dissipated_shear", "J"}, dissipated_shear);
    visit(Member{"work_of_pressure", "J"}, work_of_pressure);
  }
};

/// A vertex whose traction law has failed, a tip that has grown or come to an end, or a crack that has started.
template <int Dim>
struct CrackEvent {
  enum class Kind : std::uint8_t { failed, grew, joined, left, arrested, nucleated };
  double time = 0;  ///< s
  std::uint64_t crack = 0;
  Vec<Dim> x;                ///< m
  double G_I = 0, G_II = 0;  ///< failed: dissipated there, J/m2
  Kind kind = Kind::failed;
  std::uint8_t end = 0;      ///< of the crack, 0: start, 1: end
  double angle = 0;          ///< by which it turned to the left; nucleated: from the x axis to the crack; rad
  double speed = 0;          ///< m/s
  double J = 0;              ///< J/m2
  double K_I = 0, K_II = 0;  ///< Pa sqrt(m)

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [time, crack, x, G_I, G_II, kind, end, angle, speed, J, K_I, K_II] = self;
    visit(Member{"time", "s"}, time);
    visit(Member{"crack"}, crack);
    visit(Member{"x", "m"}, x);
    visit(Member{"G_I", "J/m2"}, G_I);
    visit(Member{"G_II", "J/m2"}, G_II);
    visit(Member{"kind"}, kind);
    visit(Member{"end"}, end);
    visit(Member{"angle", "rad"}, angle);
    visit(Member{"speed", "m/s"}, speed);
    visit(Member{"J", "J/m2"}, J);
    visit(Member{"K_I", "Pa m^(1/2)"}, K_I);
    visit(Member{"K_II", "Pa m^(1/2)"}, K_II);
  }
};

template <int Dim>
struct Ledger {
  EnergyTotals energy;
  CohesiveTotals cohesive;
  std::vector<CrackEvent<Dim>> events;  ///< since the start
  std::int64_t removed = 0;             ///< particles removed on leaving the grid
  ParticleSums<Dim> left;               ///< what they took along
  std::int64_t most_unsolved_nodes = 0, most_crowded_nodes = 0;

  std::vector<Vec<Dim>> reactions;                  ///< per condition, last step, N
  std::vector<RigidReaction<Dim>> rigid_reactions;  ///< per rigid body, last step
  std::vector<Vec<Dim>> face_areas;  ///< per loaded column (step/loaded_faces.hpp): of the deformed face over the undeformed area

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [energy, cohesive, events, removed, left, most_unsolved_nodes, most_crowded_nodes, reactions, rigid_reactions, face_areas] = self;
    visit(Member{"energy"}, energy);
    visit(Member{"cohesive"}, cohesive);
    visit(Member{"events"}, events);
    visit(Member{"removed"}, removed);
    visit(Member{"left"}, left);
    visit(Member{"most_unsolved_nodes"}, most_unsolved_nodes);
    visit(Member{"most_crowded_nodes"}, most_crowded_nodes);
    visit(Member{"reactions", "N", Use::display}, reactions);
    visit(Member{"rigid_reactions", "N, N m", Use::display}, rigid_reactions);
    visit(Member{"face_areas", "1", Use::display}, face_areas);
  }
};

}  // namespace crampon
