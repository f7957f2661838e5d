#pragma once
/// Nodes in contact, made at random, for the tests of contact/node_solve.hpp.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "crampon/contact/node_solve.hpp"

namespace crampon::test {

inline constexpr double dt = 1e-3, h = 0.01;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
  double mass() { return std::pow(10., draw(-2, 2)); }
  template <int Dim>
  Vec<Dim> vector(double size) {
    Vec<Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = draw(-size, size);
    return v;
  }
  template <int Dim>
  Vec<Dim> direction() {
    for (;;) {
      const Vec<Dim> v = vector<Dim>(1);
      if (norm(v) > 0.1 && norm(v) < 1) return normalized(v);
    }
  }

 private:
  std::mt19937_64 engine_;
};

template <int Dim>
struct Node {
  std::vector<ContactGroup<Dim>> groups;
  std::vector<ContactPair<Dim>> pairs;
  std::vector<ContactLawSpec> laws;  ///< by crack; none: pairs have their laws

  bool solve(const ContactRules& rules) {
    if (!laws.empty()) {
      for (auto& pair : pairs) pair.law = &*laws[pair.name.between_materials() ? 0 : pair.name.crack];
    }
    return solve_contact<Dim>(rules, groups.data(), static_cast<int>(groups.size()), pairs.data(), static_cast<int>(pairs.size()));
  }
  Vec<Dim> velocity_before(int g) const { return groups[static_cast<std::size_t>(g)].p * (1 / groups[static_cast<std::size_t>(g)].m); }
  Vec<Dim> velocity_after(int g) const {
    const auto& group = groups[static_cast<std::size_t>(g)];
    return (group.p + group.dp) * (1 / group.m);
  }
  /// Of b against a.
  Vec<Dim> before(const ContactPair<Dim>& q) const { return velocity_before(group(q.b)) - velocity_before(group(q.a)); }
  Vec<Dim> after(const ContactPair<Dim>& q) const { return velocity_after(group(q.b)) - velocity_after(group(q.a)); }
  double reduced_mass(const ContactPair<Dim>& q) const {
    const double a = groups[static_cast<std::size_t>(group(q.a))].m, b = groups[static_cast<std::size_t>(group(q.b))].m;
    return a * b / (a + b);
  }
  /// The one group of a side.
  static int group(GroupSet side) { return std::countr_zero(side); }
  ContactGroup<Dim>& on(GroupSet side) { return groups[static_cast<std::size_t>(group(side))]; }
  /// Largest momentum about, against which round-off is measured.
  double momentum() const {
    double largest = 0;
    for (const auto& g : groups) largest = std::fmax(largest, norm(g.p));
    return largest;
  }
  double speed() const {
    double largest = 0;
    for (const auto& g : groups) largest = std::fmax(largest, norm(g.p) / g.m);
    return largest;
  }
  Vec<Dim> sum_of_impulses() const {
    Vec<Dim> sum;
    for (const auto& g : groups) sum += g.dp;
    return sum;
  }
};

template <int Dim>
Node<Dim> random_pair(Random& random, const ContactLawSpec& law) {
  Node<Dim> node;
  for (int g = 0; g < 2; ++g) {
    ContactGroup<Dim> group;
    group.m = random.mass();
    group.p = random.vector<Dim>(3) * group.m;
    node.groups.push_back(group);
  }
  ContactPair<Dim> pair;
  const int a = random.pick(2);
  pair.a = only(a);
  pair.b = only(1 - a);
  pair.name.crack = 0;
  pair.n = random.direction<Dim>();
  pair.gap = -h;  // touching whenever the faces approach
  node.pairs = {pair};
  node.laws = {law};
  return node;
}

template <int Dim>
Vec<Dim> normal_part(const Vec<Dim>& v, const Vec<Dim>& n) {
  return n * dot(v, n);
}
template <int Dim>
Vec<Dim> tangential_part(const Vec<Dim>& v, const Vec<Dim>& n) {
  return v - normal_part(v, n);
}

template <int D>
struct Dimension {
  static constexpr int value = D;
};
using Dimensions = testing::Types<Dimension<2>, Dimension<3>>;

inline ContactRules literal_rules() {
  ContactRules rules;
  rules.literal = true;
  rules.dt = dt;
  return rules;
}

/// A few operations on numbers of the size of the momenta; masses differ by up to 1e4, and so do velocities made of them.
inline constexpr double round_off = 1e-13;

}  // namespace crampon::test
