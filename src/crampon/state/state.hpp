#pragma once
/// What a run is at the end of a step: all that the next step needs besides the model, and nothing else. What is found anew in each step is in
/// step/step_work.hpp (docs/decisions/0023-declared-state.md).

#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "crampon/core/members.hpp"
#include "crampon/core/saved_state.hpp"
#include "crampon/state/contact_memory.hpp"
#include "crampon/state/cracks.hpp"
#include "crampon/state/fracture.hpp"
#include "crampon/state/ledger.hpp"
#include "crampon/state/particle_order.hpp"
#include "crampon/state/particles.hpp"
#include "crampon/state/rigid.hpp"
#include "crampon/state/rotation.hpp"

namespace crampon {

struct RunClock {
  double time = 0;        ///< s
  std::int64_t step = 0;  ///< steps done
  double time_step = 0;   ///< that waves allow, s: found anew now and then where it may change
  double traction_time_step = std::numeric_limits<double>::infinity();        ///< longest that the springs of traction laws bear now, s
  double least_traction_time_step = std::numeric_limits<double>::infinity();  ///< ... since the start
  double next_look_for_rest = 0;                                              ///< s
  double rests_since = std::numeric_limits<double>::infinity();               ///< at every look, s

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [time, step, time_step, traction_time_step, least_traction_time_step, next_look_for_rest, rests_since] = self;
    visit(Member{"time", "s"}, time);
    visit(Member{"step"}, step);
    visit(Member{"time_step", "s"}, time_step);
    visit(Member{"traction_time_step", "s"}, traction_time_step);
    visit(Member{"least_traction_time_step", "s"}, least_traction_time_step);
    visit(Member{"next_look_for_rest", "s"}, next_look_for_rest);
    visit(Member{"rests_since", "s"}, rests_since);
  }
};

/// What conditions were in the last step: a component that was free starts from what the body does.
struct ConditionMemory {
  std::vector<bool> was_active;                   ///< per condition
  std::vector<std::int64_t> prescribed_by_rigid;  ///< node number * Dim + axis, ascending

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [was_active, prescribed_by_rigid] = self;
    visit(Member{"was_active"}, was_active);
    visit(Member{"prescribed_by_rigid"}, prescribed_by_rigid);
  }
};

/// What the columns of the history go back to: found before the first step.
struct Observed {
  double initial_energy = 0;               ///< kinetic and of strain, J
  std::vector<std::uint32_t> probes;       ///< ids of the particles that probes follow
  std::vector<std::vector<bool>> cracked;  ///< per crack and vertex: there is material on both sides

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [initial_energy, probes, cracked] = self;
    visit(Member{"initial_energy", "J", Use::display}, initial_energy);
    visit(Member{"probes", "1", Use::display}, probes);
    visit(Member{"cracked", "1", Use::display}, cracked);
  }
};

template <int Dim>
struct State {
  RunClock clock;
  Particles<Dim> particles;
  ParticleOrder order;
  Cracks<Dim> cracks;
  Fracture fracture;
  ContactMemory contacts;
  ConditionMemory conditions;
  std::vector<RigidMotion<Dim>> rigid;  ///< per rigid body
  Pieces<Dim> pieces;
  Ledger<Dim> ledger;
  Observed observed;

  State() = default;
  State(State&&) noexcept = default;
  State& operator=(State&&) noexcept = default;
  State(const State&) = delete;  // of a million particles: nobody wants it by accident
  State& operator=(const State&) = delete;

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [clock, particles, order, cracks, fracture, contacts, conditions, rigid, pieces, ledger, observed] = self;
    visit(Member{"clock"}, clock);
    visit(Member{"particles"}, particles);
    visit(Member{"order"}, order);
    visit(Member{"cracks"}, cracks);
    visit(Member{"fracture"}, fracture);
    visit(Member{"contacts"}, contacts);
    visit(Member{"conditions"}, conditions);
    visit(Member{"rigid"}, rigid);
    visit(Member{"pieces"}, pieces);
    visit(Member{"ledger"}, ledger);
    visit(Member{"observed"}, observed);
  }
};

/// A hash of all on which the further course of a run depends, to the last bit. It adds up over particles, whatever their order in memory: each
/// counts with its block, its place there, and all its arrays.
template <int Dim>
std::uint64_t hash_state(const State<Dim>& state, int threads);

}  // namespace crampon
