/// Contact of one pair at a node (contact/node_solve.hpp): the impulses (docs/theory/contact.md, impulses), the papers' detection, and
/// the consistent scheme (docs/theory/contact.md, the scheme) written once more.

#include <gtest/gtest.h>

#include "crampon/contact/laws/adhesive.hpp"
#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/contact/laws/frictionless.hpp"
#include "crampon/contact/laws/stick.hpp"
#include "unit/contact_cases.hpp"

namespace crampon::test {
namespace {

template <class D>
class ContactSolve : public testing::Test {};
TYPED_TEST_SUITE(ContactSolve, Dimensions);

TYPED_TEST(ContactSolve, FrictionCone) {
  constexpr int Dim = TypeParam::value;
  Random random(1);
  int stuck = 0, slid = 0, apart = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double friction = random.draw(0, 1.5);
    Node<Dim> node = random_pair<Dim>(random, CoulombContact{friction});
    const ContactPair<Dim> pair = node.pairs[0];
    const Vec<Dim> w = node.before(pair);
    const double m = node.reduced_mass(pair), scale = node.momentum();
    ASSERT_TRUE(node.solve(literal_rules()));
    const Vec<Dim> on_b = node.on(pair.b).dp;
    ASSERT_EQ(node.on(pair.a).dp, -on_b);  // momentum, to the bit
    ASSERT_EQ(node.pairs[0].J, on_b);
    if (dot(w, pair.n) >= 0) {
      ASSERT_EQ(on_b, Vec<Dim>{});
      ++apart;
      continue;
    }
    const double N = dot(on_b, pair.n);
    const Vec<Dim> T = tangential_part(on_b, pair.n), slip = tangential_part(w, pair.n);
    ASSERT_NEAR(N, -m * dot(w, pair.n), round_off * scale);
    ASSERT_LE(norm(T), friction * N + round_off * scale);
    ASSERT_NEAR(dot(node.after(pair), pair.n), 0, round_off * node.speed());
    if (m * norm(slip) <= friction * N) {
      ++stuck;
      const auto &a = node.groups[0], &b = node.groups[1];
      const Vec<Dim> common = (a.p + b.p) * (1 / (a.m + b.m));
      for (int g = 0; g < 2; ++g) ASSERT_LT(norm(node.velocity_after(g) - common), round_off * node.speed());
    } else {
      ++slid;
      ASSERT_NEAR(norm(T), friction * N, round_off * scale);
      // Against the slip, which keeps its direction.
      ASSERT_NEAR(dot(T, slip), -norm(T) * norm(slip), round_off * scale * node.speed());
      ASSERT_GT(dot(tangential_part(node.after(pair), pair.n), slip), 0);
    }
  }
  EXPECT_GT(stuck, 1000);
  EXPECT_GT(slid, 1000);
  EXPECT_GT(apart, 5000);
}

TYPED_TEST(ContactSolve, OtherLaws) {
  constexpr int Dim = TypeParam::value;
  Random random(2);
  for (int trial = 0; trial < 5000; ++trial) {
    Node<Dim> smooth = random_pair<Dim>(random, FrictionlessContact{});
    Node<Dim> rough = smooth, coulomb = smooth;
    rough.laws[0] = StickContact{};
    coulomb.laws[0] = CoulombContact{0};
    const ContactPair<Dim> pair = smooth.pairs[0];
    ASSERT_TRUE(smooth.solve(literal_rules()) && rough.solve(literal_rules()) && coulomb.solve(literal_rules()));
    ASSERT_EQ(coulomb.pairs[0].J, smooth.pairs[0].J);  // no friction is no friction
    if (dot(smooth.before(pair), pair.n) >= 0) {
      ASSERT_EQ(smooth.pairs[0].J, Vec<Dim>{});
      ASSERT_EQ(rough.pairs[0].J, Vec<Dim>{});
      continue;
    }
    for (int g = 0; g < 2; ++g) {
      const Vec<Dim> change = smooth.velocity_after(g) - smooth.velocity_before(g);
      ASSERT_LT(norm(tangential_part(change, pair.n)), round_off * smooth.speed());
    }
    ASSERT_LT(norm(rough.after(pair)), round_off * rough.speed());
  }
}

TYPED_TEST(ContactSolve, NoNormalMotionNoImpulse) {
  constexpr int Dim = TypeParam::value;
  for (const ContactLawSpec& law :
       {ContactLawSpec(CoulombContact{0.5}), ContactLawSpec(StickContact{}), ContactLawSpec(FrictionlessContact{})}) {
    for (const bool by_volume : {false, true}) {
      Node<Dim> node;
      node.groups.resize(2);
      node.pairs.resize(1);
      node.laws = {law};
      node.groups[0].m = 1, node.groups[1].m = 2;
      node.groups[0].p[0] = 1, node.groups[1].p[0] = -4;  // sliding along x alone: conventions 7
      node.pairs[0].a = only(0), node.pairs[0].b = only(1);
      node.pairs[0].n[1] = 1;
      node.pairs[0].gap = -h;
      node.pairs[0].volume_ratio = 1.3;
      for (const bool require_approach : {true, false}) {
        ContactRules rules = literal_rules();
        rules.volume_for_cracks = rules.volume_for_materials = by_volume;
        rules.require_approach = require_approach;
        node.solve(rules);
        EXPECT_EQ(node.groups[0].dp, Vec<Dim>{});
        EXPECT_EQ(node.groups[1].dp, Vec<Dim>{});
      }
    }
  }
}

/// N03 section 2.2 as printed, with conventions 5 and 6.
TYPED_TEST(ContactSolve, VolumeRule) {
  constexpr int Dim = TypeParam::value;
  Random random(3);
  int held_back = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    ContactRules rules = literal_rules();
    rules.volume_for_cracks = rules.volume_for_materials = true;
    rules.volume_separated = random.draw(0.7, 1);
    rules.volume_contact = rules.volume_separated + random.draw(0, 0.4);
    rules.require_approach = random.pick(2) == 0;
    const ContactLawSpec laws[] = {FrictionlessContact{}, StickContact{}, CoulombContact{random.draw(0, 1)}};
    const int law = random.pick(3);
    Node<Dim> node = random_pair<Dim>(random, laws[law]);
    node.pairs[0].gap = random.draw(-h, h);  // must not matter
    node.pairs[0].volume_ratio = random.draw(0.5, 1.6);
    const ContactPair<Dim> pair = node.pairs[0];
    const Vec<Dim> w = node.before(pair);
    const bool approach = dot(w, pair.n) < 0;
    bool touching = false;
    if (pair.volume_ratio < rules.volume_separated) {
      touching = false;
    } else if (pair.volume_ratio > rules.volume_contact) {
      touching = approach || !rules.require_approach;
    } else {
      touching = approach;
    }
    node.solve(rules);
    if (!touching) {
      ASSERT_EQ(node.pairs[0].J, Vec<Dim>{});
      continue;
    }
    if (!approach) ++held_back;
    const Vec<Dim> J = node.pairs[0].J;
    const double N = -node.reduced_mass(pair) * dot(w, pair.n), scale = node.momentum();
    ASSERT_NEAR(dot(J, pair.n), N, round_off * scale);
    const double T = norm(tangential_part(J, pair.n)), stick = node.reduced_mass(pair) * norm(tangential_part(w, pair.n));
    const double carried = law == 0   ? 0
                           : law == 1 ? stick
                                      : std::fmin(stick, node.laws[0].template as<CoulombContact>()->friction * std::fabs(N));
    ASSERT_NEAR(T, carried, round_off * scale);
    ASSERT_LE(dot(J, tangential_part(w, pair.n)), round_off * scale * node.speed());  // never speeds the slip up
  }
  EXPECT_GT(held_back, 300) << "normal sticking of N03 was never tried";
}

/// By displacement: approach, and an overlap at the end of the step (docs/theory/step.md, detection).
TYPED_TEST(ContactSolve, LiteralRuleByDisplacement) {
  constexpr int Dim = TypeParam::value;
  Random random(4);
  int closing = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    Node<Dim> node = random_pair<Dim>(random, StickContact{});
    node.pairs[0].gap = random.draw(-2, 4) * dt;  // what the pair closes in a step or so
    node.pairs[0].volume_ratio = random.draw(0, 2);
    node.pairs[0].previous = static_cast<ContactState>(random.pick(3));  // nothing is remembered
    const ContactPair<Dim> pair = node.pairs[0];
    const double w_n = dot(node.before(pair), pair.n);
    const bool touching = w_n < 0 && pair.gap + w_n * dt < 0;
    node.solve(literal_rules());
    ASSERT_EQ(node.pairs[0].J == Vec<Dim>{}, !touching);
    ASSERT_TRUE(!touching || norm(node.after(pair)) < round_off * node.speed());
    closing += touching && pair.gap > 0;
  }
  EXPECT_GT(closing, 300);
}

/// One contact over the three tasks of a step, in the words of docs/theory/contact.md, the scheme.
template <int Dim>
struct PlainContact {
  enum Law { frictionless, stick, coulomb } law;
  double friction;
  double m;  ///< reduced mass
  double gap;
  Vec<Dim> n;
  ContactState state_prev, state = ContactState::open;
  double w_end = 0;

  /// Impulse on b.
  Vec<Dim> as_usual(const Vec<Dim>& w, double J_n, ContactState& found) const {
    const Vec<Dim> w_t = tangential_part(w, n);
    const double to_stick = m * norm(w_t);
    double J_t = 0;
    found = ContactState::slip;
    if (law == stick || (law == coulomb && to_stick <= friction * J_n)) {
      J_t = to_stick;
      found = ContactState::stick;
    } else if (law == coulomb) {
      J_t = friction * J_n;
    }
    return n * J_n - normalized(w_t) * J_t;
  }
  double g() const { return state_prev == ContactState::open ? gap : std::min(gap, 0.); }

  Vec<Dim> task_2(const Vec<Dim>& w) const {
    const double w_n = dot(w, n);
    if (state_prev == ContactState::slip) return n * (-m * w_n);
    if (state_prev == ContactState::stick) return w * -m;
    ContactState ignored;
    if (w_n < -std::max(g(), 0.) / dt) return as_usual(w, m * (-std::max(g(), 0.) / dt - w_n), ignored);
    return {};
  }
  Vec<Dim> task_4(const Vec<Dim>& w) {
    const double w_n = dot(w, n);
    Vec<Dim> J;
    state = ContactState::open;
    if (w_n < -std::max(g(), 0.) / dt) J = as_usual(w, m * (-std::max(g(), 0.) / dt - w_n), state);
    w_end = w_n + dot(J, n) / m;
    return J;
  }
  Vec<Dim> task_6(const Vec<Dim>& w) const {
    if (state == ContactState::open) return {};
    const double w_n = dot(w, n), lo = std::min(w_end, 0.);
    const double target = std::min(0., std::max(w_n, lo));
    Vec<Dim> J = n * (m * (target - w_n));
    if (state == ContactState::stick) J -= tangential_part(w, n) * m;
    return J;
  }
};

TYPED_TEST(ContactSolve, ConsistentSchemeOfOnePair) {
  constexpr int Dim = TypeParam::value;
  Random random(5);
  int branch[3][3] = {};  // previous state, state found in Task 4
  int closing = 0, opening_task_6 = 0;
  for (int trial = 0; trial < 30000; ++trial) {
    PlainContact<Dim> plain;
    plain.law = static_cast<typename PlainContact<Dim>::Law>(random.pick(3));
    plain.friction = random.draw(0, 1.5);
    const ContactLawSpec laws[] = {FrictionlessContact{}, StickContact{}, CoulombContact{plain.friction}};
    Node<Dim> node = random_pair<Dim>(random, laws[plain.law]);
    ContactPair<Dim>& pair = node.pairs[0];
    pair.gap = random.draw(-2, 4) * dt;  // what the pair closes in a step or so
    pair.volume_ratio = random.draw(0, 2);
    pair.previous = static_cast<ContactState>(random.pick(3));
    plain.m = node.reduced_mass(pair);
    plain.gap = pair.gap;
    plain.n = pair.n;
    plain.state_prev = pair.previous;
    ContactRules rules;
    rules.dt = dt;
    for (const ContactTask task : {ContactTask::two, ContactTask::four, ContactTask::six}) {
      // Between the tasks momenta change by forces, or by the mapping: here, at random, also in sign.
      for (auto& g : node.groups) g.p = random.vector<Dim>(3) * g.m;
      rules.task = task;
      const Vec<Dim> w = node.before(pair);
      const Vec<Dim> expected = task == ContactTask::two ? plain.task_2(w) : task == ContactTask::four ? plain.task_4(w) : plain.task_6(w);
      ASSERT_TRUE(node.solve(rules));
      const double scale = node.momentum();
      ASSERT_LT(norm(pair.J - expected), round_off * scale)
          << "task " << static_cast<int>(task) << ", previous " << static_cast<int>(pair.previous);
      ASSERT_EQ(node.on(pair.b).dp, pair.J);
      ASSERT_EQ(node.on(pair.a).dp, -pair.J);
      if (task == ContactTask::four) {
        ASSERT_EQ(pair.state, plain.state);
        ASSERT_NEAR(pair.w_end, plain.w_end, round_off * node.speed());
        closing += plain.state != ContactState::open && plain.g() > 0;
      }
      if (task == ContactTask::six) opening_task_6 += plain.state == ContactState::slip && dot(w, plain.n) > 0;
    }
    ++branch[static_cast<int>(plain.state_prev)][static_cast<int>(plain.state)];
  }
  for (const auto& from : branch) {
    for (const int count : from) EXPECT_GT(count, 1000) << "a branch was hardly tried";
  }
  EXPECT_GT(closing, 300);
  EXPECT_GT(opening_task_6, 300);
}

/// A closed contact keeps its state while its gap reads no more than rules.stays_closed_within; beyond it, it is one that was open.
TYPED_TEST(ContactSolve, AHeldContactLetsGoBeyondItsBound) {
  constexpr int Dim = TypeParam::value;
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const bool glued = random.pick(2) == 0;
    ContactLawSpec law = CoulombContact{0.4};
    if (glued) law = AdhesiveContact{0.4, 1e30, 1e30};  // glue, too, is of faces that are not too far apart
    Node<Dim> node = random_pair<Dim>(random, law);
    ContactPair<Dim>& pair = node.pairs[0];
    pair.area = h * h;
    pair.previous = random.pick(2) == 0 ? ContactState::slip : ContactState::stick;
    ContactRules rules;
    rules.dt = dt;
    rules.task = random.pick(2) == 0 ? ContactTask::two : ContactTask::four;
    rules.stays_closed_within = random.draw(0.1, 0.4) * h;
    // The faces close a quarter of what parts them: apart, unless they are held.
    const Vec<Dim> w = node.before(pair);
    const bool held = random.pick(2) == 0;
    pair.gap = rules.stays_closed_within * (held ? random.draw(0.1, 1) : random.draw(1.01, 3));
    auto& b = node.on(pair.b);
    const double closing = -0.25 * pair.gap / dt;
    b.p += pair.n * (b.m * (closing - dot(w, pair.n)));
    ASSERT_TRUE(node.solve(rules));
    if (held) {
      ASSERT_NEAR(dot(pair.J, pair.n), -closing * node.reduced_mass(pair), round_off * node.momentum());
    } else {
      ASSERT_EQ(pair.J, Vec<Dim>{});
    }
  }
}

TYPED_TEST(ContactSolve, FixedComponentsStayAsTheyAre) {
  constexpr int Dim = TypeParam::value;
  Random random(6);
  for (int trial = 0; trial < 2000; ++trial) {
    Node<Dim> node = random_pair<Dim>(random, CoulombContact{0.4});
    Node<Dim> free = node;
    ContactRules rules;
    rules.dt = dt;
    rules.task = ContactTask::four;
    free.solve(rules);
    rules.fixed_axes = 1u << random.pick(Dim);
    node.solve(rules);
    for (int k = 0; k < Dim; ++k) {
      const double expected = rules.fixed_axes >> k & 1u ? 0. : free.pairs[0].J[k];
      ASSERT_EQ(node.pairs[0].J[k], expected);
      ASSERT_EQ(node.on(node.pairs[0].b).dp[k], expected);
      ASSERT_EQ(node.on(node.pairs[0].a).dp[k], -expected);
    }
  }
}

}  // namespace
}  // namespace crampon::test
