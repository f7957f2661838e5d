/// Sides of several groups, rigid groups and N13's virtual material at one node (contact/node_solve.hpp).

#include <gtest/gtest.h>

#include "crampon/contact/laws/bonded.hpp"
#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/contact/laws/frictionless.hpp"
#include "crampon/contact/laws/stick.hpp"
#include "unit/contact_cases.hpp"

namespace crampon::test {
namespace {

template <class D>
class ContactSides : public testing::Test {};
TYPED_TEST_SUITE(ContactSides, Dimensions);

template <int Dim>
ContactGroup<Dim> random_group(Random& random) {
  ContactGroup<Dim> group;
  group.m = random.mass();
  group.p = random.vector<Dim>(3) * group.m;
  return group;
}

/// Materials 0..count-1 that all meet each other, or each the lump of the others.
template <int Dim>
Node<Dim> materials(Random& random, int count, const ContactLawSpec& law, bool as_virtual) {
  Node<Dim> node;
  node.laws = {law};
  for (int g = 0; g < count; ++g) node.groups.push_back(random_group<Dim>(random));
  const GroupSet all = (GroupSet{1} << count) - 1;
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < (as_virtual ? a + 2 : count); ++b) {
      ContactPair<Dim> pair;
      pair.a = only(a);
      pair.b = as_virtual ? all & ~only(a) : only(b);
      pair.name.field_a = static_cast<std::uint16_t>(a);
      pair.name.field_b = as_virtual ? ContactName::all_others : static_cast<std::uint16_t>(b);
      pair.n = random.direction<Dim>();
      pair.gap = -h;
      node.pairs.push_back(pair);
    }
  }
  return node;
}

/// docs/theory/contact.md: momentum is exact for two, three and four materials with friction, in both ways and schemes.
TYPED_TEST(ContactSides, SeveralMaterialsKeepMomentum) {
  constexpr int Dim = TypeParam::value;
  Random random(31);
  int acted = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int count = 2 + random.pick(3);
    Node<Dim> node = materials<Dim>(random, count, CoulombContact{random.draw(0, 1)}, random.pick(2) == 0 && count > 2);
    ContactRules rules = random.pick(2) == 0 ? literal_rules() : ContactRules{};
    rules.dt = dt;
    rules.task = random.pick(2) == 0 ? ContactTask::two : ContactTask::four;
    node.solve(rules);  // normals at random: a solution need not exist, momentum must be kept all the same
    ASSERT_LT(norm(node.sum_of_impulses()), 1e-12 * std::fmax(node.momentum(), 1e-3));
    for (const auto& group : node.groups) acted += group.dp != Vec<Dim>{};
  }
  EXPECT_GT(acted, 3000);
}

/// N13 Eqs. 7-9 with sticking: every material takes the velocity of the centre of mass.
TYPED_TEST(ContactSides, VirtualMaterialsThatStickMoveAsOne) {
  constexpr int Dim = TypeParam::value;
  Random random(32);
  for (int trial = 0; trial < 500; ++trial) {
    Node<Dim> node = materials<Dim>(random, 3 + random.pick(3), BondedContact{}, true);
    ASSERT_TRUE(node.solve(literal_rules()));
    double m = 0;
    Vec<Dim> p;
    for (const auto& g : node.groups) m += g.m, p += g.p;
    for (std::size_t g = 0; g < node.groups.size(); ++g) {
      ASSERT_LT(norm(node.velocity_after(static_cast<int>(g)) - p * (1 / m)), round_off * node.speed() * 100);
    }
  }
}

/// A rigid group keeps its velocity; the other leaves with Delta p = -m (v_a - v_b) (N13 Eq. 14), and what one gets the other gives.
TYPED_TEST(ContactSides, RigidGroupsStay) {
  constexpr int Dim = TypeParam::value;
  Random random(33);
  for (int trial = 0; trial < 2000; ++trial) {
    Node<Dim> node = random_pair<Dim>(random, StickContact{});
    const int r = random.pick(2);
    auto &rigid = node.groups[static_cast<std::size_t>(r)], &other = node.groups[static_cast<std::size_t>(1 - r)];
    rigid.rigid = true;
    const Vec<Dim> v = rigid.velocity();
    const ContactPair<Dim> pair = node.pairs[0];
    const bool approach = dot(node.before(pair), pair.n) < 0;
    ASSERT_TRUE(node.solve(literal_rules()));
    ASSERT_EQ(rigid.velocity(), v);
    ASSERT_EQ(rigid.dp, -other.dp);
    const Vec<Dim> expected = approach ? (v - other.p * (1 / other.m)) * other.m : Vec<Dim>{};
    ASSERT_LT(norm(other.dp - expected), round_off * (norm(other.p) + other.m * norm(v)));
  }
}

/// Sides of several groups meet with their common velocity and share by mass (conventions 34); the joint solution holds every pair.
TYPED_TEST(ContactSides, SidesOfACrackShareByMass) {
  constexpr int Dim = TypeParam::value;
  Random random(34);
  for (int trial = 0; trial < 1000; ++trial) {
    Node<Dim> node;
    node.laws = {FrictionlessContact{}};
    for (int g = 0; g < 4; ++g) node.groups.push_back(random_group<Dim>(random));
    ContactPair<Dim> pair;
    pair.a = only(0) | only(1);
    pair.b = only(2) | only(3);
    pair.name.crack = 0;
    pair.n = random.direction<Dim>();
    pair.gap = -h;
    node.pairs = {pair};
    const auto before = side_of(node.groups.data(), pair.b).v - side_of(node.groups.data(), pair.a).v;
    ASSERT_TRUE(node.solve(literal_rules()));
    const auto after = side_of(node.groups.data(), pair.b).v - side_of(node.groups.data(), pair.a).v;
    ASSERT_NEAR(dot(after, pair.n), std::fmax(dot(before, pair.n), 0.), 1e-12 * node.speed());
    ASSERT_LT(norm(node.sum_of_impulses()), round_off * node.momentum());
    for (const int first : {0, 2}) {
      const auto &a = node.groups[static_cast<std::size_t>(first)], &b = node.groups[static_cast<std::size_t>(first + 1)];
      ASSERT_LT(norm(a.dp * b.m - b.dp * a.m), 1e-12 * (norm(a.dp) * b.m + norm(b.dp) * a.m + 1e-300));
    }
  }
}

}  // namespace
}  // namespace crampon::test
