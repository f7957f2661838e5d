#pragma once
/// Where rigid bodies are and how they move in a step.

#include <array>

#include "crampon/core/members.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// Spin as a vector; in 2D its z component alone.
using Spin = Vec<3>;

/// A turn: rows of the matrix that takes the body at the start to the body now.
template <int Dim>
using Turn = std::array<Vec<Dim>, Dim>;

template <int Dim>
Turn<Dim> no_turn() {
  Turn<Dim> out{};
  for (std::size_t k = 0; k < Dim; ++k) out[k][k] = 1;
  return out;
}

/// Motion of a rigid body at one instant.
template <int Dim>
struct RigidPose {
  Vec<Dim> centre;  ///< m
  Vec<Dim> pivot;   ///< the centre at the time of the velocity, about which it turns, m
  Turn<Dim> turn = no_turn<Dim>();
  Vec<Dim> velocity;  ///< of the centre, m/s
  Spin spin;          ///< rad/s

  /// A point of the body that started at start_centre + arm.
  Vec<Dim> place(const Vec<Dim>& arm) const {
    Vec<Dim> x = centre;
    for (std::size_t k = 0; k < Dim; ++k) x[k] += dot(turn[k], arm);
    return x;
  }
  Vec<Dim> velocity_at(const Vec<Dim>& x) const {
    const Vec<Dim> r = x - pivot;
    Vec<Dim> v = velocity;
    v[0] -= spin[2] * r[1];
    v[1] += spin[2] * r[0];
    if constexpr (Dim == 3) {
      v[0] += spin[1] * r[2];
      v[1] -= spin[0] * r[2];
      v[2] += spin[0] * r[1] - spin[1] * r[0];
    }
    return v;
  }

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [centre, pivot, turn, velocity, spin] = self;
    visit(Member{"centre", "m"}, centre);
    visit(Member{"pivot", "m"}, pivot);
    visit(Member{"turn"}, turn);
    visit(Member{"velocity", "m/s"}, velocity);
    visit(Member{"spin", "rad/s"}, spin);
  }
};

/// A rigid body over a step. `start` and `end` have the velocities of the start and the end of the step, and places that lead these times as
/// positions of particles do.
template <int Dim>
struct RigidMotion {
  RigidPose<Dim> start, end;
  RigidPose<Dim> present, present_end;  ///< places at the start and the end of the step

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [start, end, present, present_end] = self;
    visit(Member{"start"}, start);
    visit(Member{"end"}, end);
    visit(Member{"present"}, present);
    visit(Member{"present_end"}, present_end);
  }
};

/// What bodies that deform feel from a rigid one.
template <int Dim>
struct RigidReaction {
  Vec<Dim> force;  ///< on them, N
  Spin torque;     ///< of that force about the body's centre, N m

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [force, torque] = self;
    visit(Member{"force", "N", Use::display}, force);
    visit(Member{"torque", "N m", Use::display}, torque);
  }
};

}  // namespace crampon
