#pragma once
/// What every contact law must do, as checks of one law: contact_family_test applies them to all that are registered, and
/// toy_contact_test shows that checks find laws that break them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "crampon/contact/law.hpp"
#include "crampon/contact/pair_work.hpp"
#include "unit/contact_cases.hpp"

namespace crampon::test {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Two faces as in practice: pressures from a kilopascal to ten megapascal, slip from a micrometre to a decimetre, speeds from a millimetre to ten metres
/// a second.
inline Sliding contact_as_in_practice(Random& random) {
  const auto decades = [&](double low, double high) { return std::pow(10., random.draw(low, high)); };
  Sliding s;
  s.area = decades(-6, -2);
  s.dt = decades(-7, -3);
  s.normal = decades(3, 7) * s.area * s.dt;
  s.full = s.normal * decades(-2, 2);
  s.mass = s.full / decades(-3, 1);
  s.slip = decades(-6, -1);
  return s;
}

/// The tangential impulse that acts, kg m/s.
inline double impulse(const ContactLaw& law, const Sliding& s) {
  const SlidingLimit limit = law.limit(s);
  return limit.sticks ? s.full : limit.per_normal * s.normal + limit.rest;
}

/// Friction resists slip and never turns it round.
inline void check_limit_resists(const ContactLaw& law) {
  Random random(1);
  for (int trial = 0; trial < 5000; ++trial) {
    const Sliding s = contact_as_in_practice(random);
    const SlidingLimit limit = law.limit(s);
    EXPECT_TRUE(std::isfinite(limit.per_normal) && std::isfinite(limit.rest));
    EXPECT_GE(limit.per_normal, 0);
    EXPECT_GE(limit.rest, 0);
    EXPECT_LE(impulse(law, s), s.full * (1 + 1e-14));
    if (testing::Test::HasFailure()) return;
  }
}

/// A law that does not need the area, or does not remember slip, gives the same answer whatever stands in their place: it does not read them.
inline void check_reads_what_it_asks_for(const ContactLaw& law) {
  Random random(2);
  for (int trial = 0; trial < 5000; ++trial) {
    const Sliding given = contact_as_in_practice(random);
    Sliding asked = given;
    if (!law.needs_area()) asked.area = not_a_number;
    if (law.remembers() != Remembered::slip) asked.slip = not_a_number;
    const SlidingLimit a = law.limit(given), b = law.limit(asked);
    EXPECT_TRUE(a.sticks == b.sticks && a.per_normal == b.per_normal && a.rest == b.rest)
        << "reads the area or the slip without asking for it";
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_TRUE(!law.adheres() || law.needs_area()) << "glue of no area does not hold";
  EXPECT_TRUE(!law.has_springs() || law.needs_area()) << "springs need the area";
}

/// What the law asks for changes its answer somewhere; else contact finds areas, or particles remember, for nothing.
inline void check_asks_for_nothing_in_vain(const ContactLaw& law) {
  Random random(3);
  bool by_area = law.has_springs(), by_slip = false;
  for (int trial = 0; trial < 5000; ++trial) {
    const Sliding s = contact_as_in_practice(random);
    Sliding wider = s, further = s;
    wider.area *= 2;
    further.slip *= 2;
    by_area = by_area || impulse(law, wider) != impulse(law, s);
    by_slip = by_slip || impulse(law, further) != impulse(law, s);
  }
  EXPECT_EQ(by_area, law.needs_area());
  EXPECT_EQ(by_slip, law.remembers() == Remembered::slip);
  EXPECT_EQ(law.remembers() == Remembered::failure, law.has_springs() && law.springs().can_fail());
}

/// Four contacts beside each other resist as four times one. The same stresses over a quarter of the time give a quarter of the impulse. Both hold to
/// the bit, as four is a power of two.
inline void check_limit_is_a_stress(const ContactLaw& law) {
  Random random(4);
  for (int trial = 0; trial < 5000; ++trial) {
    const Sliding s = contact_as_in_practice(random);
    const Sliding wider{4 * s.normal, 4 * s.full, 4 * s.mass, s.dt, 4 * s.area, s.slip};
    const Sliding shorter{s.normal / 4, s.full / 4, s.mass / 4, s.dt / 4, s.area, s.slip};
    EXPECT_DOUBLE_EQ(impulse(law, wider), 4 * impulse(law, s)) << "does not grow with the area";
    EXPECT_DOUBLE_EQ(impulse(law, shorter), impulse(law, s) / 4) << "does not fall with the time";
    if (testing::Test::HasFailure()) return;
  }
}

/// What holds under a pull and a shear holds under less of both; nothing holds without an area; a law that does not adhere never holds.
inline void check_adhesion(const ContactLaw& law) {
  Random random(5);
  int held = 0, let_go = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Sliding s = contact_as_in_practice(random);
    const Pull pull{s.normal, s.full * random.draw(0, 1), s.dt, s.area};
    const bool holds = law.holds(pull);
    ++(holds ? held : let_go);
    EXPECT_FALSE(law.holds({pull.normal, pull.full, pull.dt, 0}));
    EXPECT_TRUE(!holds || law.holds({0.5 * pull.normal, 0.5 * pull.full, pull.dt, pull.area})) << "holds more than it holds";
    EXPECT_EQ(law.holds({4 * pull.normal, 4 * pull.full, pull.dt, 4 * pull.area}), holds) << "does not grow with the area";
    EXPECT_EQ(law.holds({pull.normal / 4, pull.full / 4, pull.dt / 4, pull.area}), holds) << "does not fall with the time";
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(held > 0, law.adheres());
  EXPECT_GT(let_go, 0);
}

/// Slip is added up while faces slide, and by no other law.
inline void check_memory_grows(const ContactLaw& law) {
  Random random(6);
  for (int trial = 0; trial < 1000; ++trial) {
    ContactPair<3> pair;
    pair.law = &law;
    pair.n = random.direction<3>();
    pair.w_settled = random.vector<3>(3);
    for (const ContactState state : {ContactState::open, ContactState::stick, ContactState::slip}) {
      pair.history_gain = 0;
      pair.state = state;
      note_slip(pair, random.vector<3>(3), dt);
      EXPECT_GE(pair.history_gain, 0);
      EXPECT_EQ(pair.history_gain > 0, law.remembers() == Remembered::slip && state == ContactState::slip);
    }
    if (!law.has_springs()) continue;
    pair.area = 1e-4;
    pair.J = random.vector<3>(1);
    const double load = interface_load(pair, dt);
    pair.J *= 2;
    EXPECT_TRUE(load == 0 || law.springs().can_fail());
    EXPECT_GE(interface_load(pair, dt), load) << "more force brings springs no nearer to failure";
  }
}

/// Two bodies at a node as the nodal solve finds them; where the law does not ask for the area or the slip, there is no number in their place.
template <int Dim>
Node<Dim> node_with(Random& random, const ContactLaw& law) {
  Node<Dim> node = random_pair<Dim>(random, {});
  ContactPair<Dim>& pair = node.pairs[0];
  node.laws.clear();
  pair.law = &law;
  pair.area = law.needs_area() ? std::pow(10., random.draw(-3, 1)) : not_a_number;
  pair.history = law.remembers() == Remembered::slip ? random.draw(0, 0.1) : law.has_springs() ? 0 : not_a_number;
  pair.previous = random.pick(2) ? ContactState::stick : ContactState::open;
  if (law.has_springs()) {
    pair.opening = random.vector<Dim>(1e-4);
    pair.w_settled = random.vector<Dim>(1);
  }
  return node;
}

/// All schemes and tasks in which a law has a say.
template <class F>
void for_rules(F f) {
  for (const bool literal : {true, false}) {
    for (const ContactTask task : {ContactTask::two, ContactTask::four}) {
      ContactRules rules = literal_rules();
      rules.literal = literal;
      rules.task = task;
      f(rules);
    }
  }
}

/// Action equals reaction; what moves along with both bodies changes nothing; it does not matter which of the two is called a.
template <int Dim>
void check_symmetries(const ContactLaw& law) {
  Random random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const Node<Dim> start = node_with<Dim>(random, law);
    const Vec<Dim> along = random.vector<Dim>(3);
    for_rules([&](const ContactRules& rules) {
      Node<Dim> node = start, moved = start, swapped = start;
      for (auto& group : moved.groups) group.p += along * group.m;
      ContactPair<Dim>& other = swapped.pairs[0];
      std::swap(other.a, other.b);
      other.n = -other.n;
      other.opening = -other.opening;
      other.w_settled = -other.w_settled;
      for (Node<Dim>* each : {&node, &moved, &swapped}) EXPECT_TRUE(each->solve(rules));
      const double small = round_off * moved.momentum() + round_off * node.momentum() + round_off * norm(node.pairs[0].J);
      EXPECT_LE(norm(node.sum_of_impulses()), small) << "action is not reaction";
      for (std::size_t g = 0; g < 2; ++g) {
        for (int k = 0; k < Dim; ++k) EXPECT_TRUE(std::isfinite(node.groups[g].dp[k]));
        EXPECT_LE(norm(moved.groups[g].dp - node.groups[g].dp), 1e3 * small) << "depends on the frame";
        EXPECT_LE(norm(swapped.groups[g].dp - node.groups[g].dp), small) << "depends on which side is called a";
      }
    });
    if (testing::Test::HasFailure()) return;
  }
}

/// Faces that press: they do not go on to overlap, nothing pulls unless it adheres, friction is against slip and within the law's limit, and the two
/// bodies have no more energy after than before.
template <int Dim>
void check_impulses(const ContactLaw& law) {
  if (law.meeting() != Meeting::pressing) return;
  Random random(8);
  int met = 0, pulled = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Node<Dim> start = node_with<Dim>(random, law);
    for_rules([&](ContactRules rules) {
      if (rules.task != ContactTask::four) return;  // Task 2 holds what Task 4 has found before
      Node<Dim> node = start;
      ASSERT_TRUE(node.solve(rules));
      const ContactPair<Dim>& pair = node.pairs[0];
      const double m = node.reduced_mass(pair), small = round_off * (node.momentum() + norm(pair.J));
      const Vec<Dim> w_before = node.before(pair), w_after = node.after(pair);
      const double J_n = dot(pair.J, pair.n);
      const Vec<Dim> J_t = tangential_part(pair.J, pair.n), w_t = tangential_part(w_before, pair.n);
      EXPECT_GE(dot(w_after, pair.n) * m, -small) << "goes on to overlap";
      if (J_n < -small) {
        ++pulled;
        EXPECT_TRUE(law.adheres()) << "pulls";
        EXPECT_TRUE(law.holds({-J_n, norm(w_t) * m, rules.dt, pair.area})) << "pulls more than it holds";
      } else if (norm(pair.J) > small) {
        ++met;
        EXPECT_LE(dot(J_t, w_t), small * norm(w_t)) << "friction drives";
        EXPECT_GE(dot(tangential_part(w_after, pair.n), w_t), -small * norm(w_t) / m) << "friction turns slip round";
        const Sliding sliding{std::fabs(J_n), norm(w_t) * m, m, rules.dt, pair.area, pair.history};
        EXPECT_LE(norm(J_t), impulse(law, sliding) * (1 + 1e-9) + small) << "exceeds the limit";
      }
      double gained = 0;
      for (int g = 0; g < 2; ++g) {
        const double mass = node.groups[static_cast<std::size_t>(g)].m;
        gained +=
            0.5 * mass * (dot(node.velocity_after(g), node.velocity_after(g)) - dot(node.velocity_before(g), node.velocity_before(g)));
      }
      EXPECT_LE(gained, small * node.speed()) << "gains energy";
    });
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(met, 500);
  EXPECT_EQ(pulled > 0, law.adheres());
}

/// Joined faces move as one, whatever they did before.
template <int Dim>
void check_joined(const ContactLaw& law) {
  if (!law.bonds()) return;
  Random random(9);
  for (int trial = 0; trial < 100; ++trial) {
    const Node<Dim> start = node_with<Dim>(random, law);
    for_rules([&](const ContactRules& rules) {
      Node<Dim> node = start;
      ASSERT_TRUE(node.solve(rules));
      EXPECT_LE(norm(node.after(node.pairs[0])) * node.reduced_mass(node.pairs[0]), round_off * (node.momentum() + norm(node.pairs[0].J)));
    });
  }
}

}  // namespace crampon::test
