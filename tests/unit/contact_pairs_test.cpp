/// Several pairs in contact at one node (contact/node_solve.hpp), by what must hold after them.

#include <gtest/gtest.h>

#include <string>

#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/contact/laws/frictionless.hpp"
#include "crampon/contact/laws/stick.hpp"
#include "unit/contact_cases.hpp"

namespace crampon::test {
namespace {

template <class D>
class ContactPairs : public testing::Test {};
TYPED_TEST_SUITE(ContactPairs, Dimensions);

/// The fields of a node with two crossing cracks: {}, {0}, {1}, {0, 1} as groups 0..3. Pairs of one crack share a normal (conventions 25).
/// With three cracks of which each cuts one more field off: a chain.
template <int Dim>
Node<Dim> random_node(Random& random, const ContactLawSpec& law, int pairs) {
  Node<Dim> node;
  const bool crossing = pairs == 4;
  const int groups = crossing ? 4 : pairs + 1, cracks = crossing ? 2 : pairs;
  std::vector<Vec<Dim>> n;
  for (int c = 0; c < cracks; ++c) {
    // Cracks cross or branch at angles of more than some 25 degrees.
    Vec<Dim> direction;
    bool distinct = false;
    while (!distinct) {
      direction = random.direction<Dim>();
      distinct = true;
      for (const auto& other : n) distinct = distinct && std::fabs(dot(direction, other)) < 0.9;
    }
    n.push_back(direction);
    node.laws.push_back(law);
  }
  for (int g = 0; g < groups; ++g) {
    ContactGroup<Dim> group;
    group.m = std::pow(10., random.draw(-0.5, 0.5));
    group.p = random.vector<Dim>(3) * group.m;
    node.groups.push_back(group);
  }
  const auto add = [&](int a, int b, int crack) {
    ContactPair<Dim> pair;
    pair.a = only(a), pair.b = only(b);
    pair.name.crack = static_cast<CrackId>(crack);
    pair.n = n[static_cast<std::size_t>(crack)];
    pair.gap = random.draw(-1, 1) * dt;
    node.pairs.push_back(pair);
  };
  if (crossing) {
    add(0, 1, 0), add(2, 3, 0), add(0, 2, 1), add(1, 3, 1);
  } else {
    for (int q = 0; q < pairs; ++q) add(q, q + 1, q);
  }
  return node;
}

/// 200 sweeps end with a change below 1e-14 of the largest impulse in each; what is left is that over (1 - rate of convergence).
constexpr double after_sweeps = 1e-11;

TYPED_TEST(ContactPairs, StickingPairsReachTheJointVelocity) {
  constexpr int Dim = TypeParam::value;
  Random random(7);
  for (int pairs = 2; pairs <= 4; ++pairs) {
    for (int trial = 0; trial < 500; ++trial) {
      Node<Dim> node = random_node<Dim>(random, StickContact{}, pairs);
      for (auto& pair : node.pairs) pair.previous = ContactState::stick;
      ContactRules rules;
      rules.dt = dt;
      ASSERT_TRUE(node.solve(rules));
      double mass = 0;
      Vec<Dim> momentum;
      for (const auto& g : node.groups) mass += g.m, momentum += g.p;
      for (std::size_t g = 0; g < node.groups.size(); ++g) {
        ASSERT_LT(norm(node.velocity_after(static_cast<int>(g)) - momentum * (1 / mass)), after_sweeps * node.speed()) << pairs << " pairs";
      }
      // Opposite impulses, summed pair by pair and sweep by sweep.
      ASSERT_LT(norm(node.sum_of_impulses()), round_off * node.momentum());
    }
  }
}

TYPED_TEST(ContactPairs, SeveralPairsEndComplementary) {
  constexpr int Dim = TypeParam::value;
  Random random(8);
  for (int pairs = 2; pairs <= 4; ++pairs) {
    for (const double friction : {0., 0.3}) {
      const ContactLawSpec law = friction == 0 ? ContactLawSpec(FrictionlessContact{}) : ContactLawSpec(CoulombContact{friction});
      int unsolved = 0, active = 0, inactive = 0;
      const int trials = 2000;
      for (int trial = 0; trial < trials; ++trial) {
        Node<Dim> node = random_node<Dim>(random, law, pairs);
        ContactRules rules;
        rules.dt = dt;
        rules.task = ContactTask::four;
        if (!node.solve(rules)) {
          ++unsolved;
          continue;
        }
        const double speed = node.speed(), scale = node.momentum();
        ASSERT_LT(norm(node.sum_of_impulses()), round_off * scale);
        for (const auto& pair : node.pairs) {
          const Vec<Dim> w = node.after(pair);
          const double bound = -std::max(pair.gap, 0.) / dt, N = dot(pair.J, pair.n);
          // No pair closes faster than its gap allows ...
          ASSERT_GT(dot(w, pair.n), bound - after_sweeps * speed);
          // ... none is pulled, and none is pushed that does not meet its bound.
          ASSERT_GE(N, -round_off * scale);
          const Vec<Dim> T = tangential_part(pair.J, pair.n), slip = tangential_part(w, pair.n);
          ASSERT_LE(norm(T), friction * N + round_off * scale);
          ASSERT_NEAR(pair.w_end, dot(w, pair.n), round_off * speed);
          if (pair.state == ContactState::open) {
            ++inactive;
            ASSERT_EQ(pair.J, Vec<Dim>{});
            continue;
          }
          ++active;
          ASSERT_NEAR(dot(w, pair.n), bound, after_sweeps * speed);
          if (pair.state == ContactState::stick) {
            ASSERT_LT(norm(slip), after_sweeps * speed);
          } else if (norm(T) > 1e-9 * scale) {
            ASSERT_NEAR(norm(T), friction * N, after_sweeps * scale);
            ASSERT_NEAR(dot(T, slip), -norm(T) * norm(slip), after_sweeps * scale * speed);
          }
        }
      }
      this->RecordProperty("unsolved_" + std::to_string(pairs) + (friction > 0 ? "_friction" : ""), unsolved);
      // Nearly parallel faces may need more than 200 sweeps, and friction on a ring of faces need not converge at all.
      EXPECT_LE(unsolved, trials / 100) << pairs << " pairs, friction " << friction;
      EXPECT_GT(active, trials / 4);
      EXPECT_GT(inactive, trials / 4);
    }
  }
}

/// A body that flies past has the contacts of one at rest: small impulses beside large momenta are no failure to converge.
TYPED_TEST(ContactPairs, ACommonVelocityDoesNotMatter) {
  constexpr int Dim = TypeParam::value;
  Random random(10);
  for (int trial = 0; trial < 200; ++trial) {
    Node<Dim> rest = random_node<Dim>(random, FrictionlessContact{}, 2);
    Node<Dim> flying = rest;
    const Vec<Dim> common = random.direction<Dim>() * 1e4;
    for (auto& g : flying.groups) g.p += common * g.m;
    ContactRules rules;
    rules.dt = dt;
    rules.task = ContactTask::four;
    const bool solved = rest.solve(rules), solved_flying = flying.solve(rules);
    ASSERT_TRUE(!solved || solved_flying) << "trial " << trial;
    for (std::size_t q = 0; q < 2; ++q) ASSERT_LT(norm(rest.pairs[q].J - flying.pairs[q].J), 100 * round_off * flying.momentum());
  }
}

/// conventions 13: where sweeps over the pairs settle, that is the solution; ring-like contacts have others, with other shares.
TYPED_TEST(ContactPairs, ASolutionOfPlainSweepsIsKept) {
  constexpr int Dim = TypeParam::value;
  Random random(12);
  constexpr double friction = 0.3;
  int settled = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Node<Dim> node = random_node<Dim>(random, CoulombContact{friction}, 4);
    for (auto& pair : node.pairs) pair.gap = -h;
    ContactRules rules = literal_rules();
    Node<Dim> swept = node;
    std::vector<Vec<Dim>> J(swept.pairs.size());
    bool done = false;
    for (int sweep = 0; sweep < 200 && !done; ++sweep) {
      double change = 0;
      for (std::size_t q = 0; q < J.size(); ++q) {
        const auto& pair = swept.pairs[q];
        const double m = swept.reduced_mass(pair);
        const Vec<Dim> w = swept.after(pair) - J[q] * (1 / m);
        Vec<Dim> next;
        if (const double w_n = dot(w, pair.n); w_n < 0) {
          const Vec<Dim> slip = tangential_part(w, pair.n);
          const double stick = m * norm(slip), most = -friction * m * w_n;
          next = pair.n * (-m * w_n) - slip * (stick > most ? most / norm(slip) : m);
        }
        swept.on(pair.a).dp -= next - J[q];
        swept.on(pair.b).dp += next - J[q];
        change = std::fmax(change, norm(next - J[q]));
        J[q] = next;
      }
      done = change <= 1e-15 * swept.momentum();
    }
    if (!done) continue;
    ++settled;
    ASSERT_TRUE(node.solve(rules)) << "trial " << trial;
    for (int g = 0; g < 4; ++g) ASSERT_LT(norm(node.velocity_after(g) - swept.velocity_after(g)), after_sweeps * node.speed());
  }
  EXPECT_GT(settled, 300);
}

/// A thin sliver between two thick pieces, as beside an acute crossing: what passes through the light field must come out at the other end.
TYPED_TEST(ContactPairs, LightFieldBetweenHeavyOnes) {
  constexpr int Dim = TypeParam::value;
  for (const ContactLawSpec& law : {ContactLawSpec(StickContact{}), ContactLawSpec(FrictionlessContact{})}) {
    for (const double light : {1e-1, 1e-2, 1e-4}) {
      Node<Dim> node;
      node.laws = {law, law};
      node.groups.resize(3);
      node.pairs.resize(2);
      for (auto& g : node.groups) g.m = 1;
      node.groups[1].m = light;
      node.groups[0].p[0] = 1, node.groups[2].p[0] = -0.5;
      for (int q = 0; q < 2; ++q) {
        ContactPair<Dim>& pair = node.pairs[static_cast<std::size_t>(q)];
        pair.a = only(q), pair.b = only(q + 1);
        pair.name.crack = static_cast<CrackId>(q);
        pair.n[0] = 1;
        pair.gap = -h;
      }
      ContactRules rules;
      rules.dt = dt;
      rules.task = ContactTask::four;
      EXPECT_TRUE(node.solve(rules)) << "mass ratio " << light;
      for (int g = 0; g < 3; ++g) EXPECT_NEAR(node.velocity_after(g)[0], 0.5 / (2 + light), after_sweeps) << "mass ratio " << light;
    }
  }
}

/// N13's way, one pair after another once, is there on request and is not the joint one (conventions 13).
TYPED_TEST(ContactPairs, SequentialPairsAreDoneOnce) {
  constexpr int Dim = TypeParam::value;
  Random random(9);
  for (int trial = 0; trial < 200; ++trial) {
    Node<Dim> node = random_node<Dim>(random, StickContact{}, 4);
    for (auto& pair : node.pairs) pair.gap = -h;
    Node<Dim> plain = node;
    ContactRules rules = literal_rules();
    rules.sequential = true;
    ASSERT_TRUE(node.solve(rules));
    for (auto& pair : plain.pairs) {
      auto &a = plain.on(pair.a), &b = plain.on(pair.b);
      const Vec<Dim> w = b.p * (1 / b.m) - a.p * (1 / a.m);
      if (dot(w, pair.n) >= 0) continue;
      const Vec<Dim> common = (a.p + b.p) * (1 / (a.m + b.m));
      a.p = common * a.m;
      b.p = common * b.m;
    }
    for (std::size_t g = 0; g < 4; ++g) {
      ASSERT_LT(norm(node.groups[g].p + node.groups[g].dp - plain.groups[g].p), round_off * node.momentum());
    }
  }
}

}  // namespace
}  // namespace crampon::test
