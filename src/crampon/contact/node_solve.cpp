#include "crampon/contact/node_solve.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/contact/pair_response.hpp"
#include "crampon/contact/solve_together.hpp"

namespace crampon {

namespace {

/// Adds an impulse to a side, shared by mass.
template <int Dim>
void give(ContactGroup<Dim>* groups, GroupSet set, double mass, const Vec<Dim>& impulse) {
  if (std::has_single_bit(set)) {
    groups[std::countr_zero(set)].dp += impulse;
  } else {
    for_groups(set, [&](int g) { groups[g].dp += impulse * (groups[g].m / mass); });
  }
}

/// The pairs of a node, solved one by one and together.
template <int Dim>
class NodeSolve {
 public:
  NodeSolve(const ContactRules& rules, ContactGroup<Dim>* groups, int group_count, ContactPair<Dim>* pairs, int pair_count)
      : rules_(rules), groups_(groups), group_count_(group_count), pairs_(pairs), pair_count_(pair_count) {
    for (int g = 0; g < group_count; ++g) groups[g].dp = {};
    for (int q = 0; q < pair_count; ++q) pairs[q].J = {};
  }

  bool run() {
    while (first_ < pair_count_ && pairs_[first_].is_virtual()) meet_the_others();
    for (int q = first_; q < pair_count_; ++q) {
      const PairSide<Dim> a = side_of(groups_, pairs_[q].a), b = side_of(groups_, pairs_[q].b);
      momentum_ = std::fmax(momentum_, reduced_mass(a, b) * (norm(a.v) + norm(b.v)));
    }
    if (pair_count_ - first_ <= 1 || rules_.sequential) {
      sweep();
      return true;
    }
    for (int sweeps = 0; sweeps < most_sweeps; ++sweeps) {
      if (sweep()) return true;
    }
    return help_along();
  }

 private:
  static constexpr int most_sweeps = 200;  // conventions 13

  /// N13 Eqs. 7-9: every material of one crack field against all others there, from the same momenta; what is then wanting of the total
  /// is shared out by mass (conventions 35).
  void meet_the_others() {
    const GroupSet all = pairs_[first_].a | pairs_[first_].b;
    const int begin = first_;
    while (first_ < pair_count_ && pairs_[first_].is_virtual() && (pairs_[first_].a | pairs_[first_].b) == all) ++first_;
    std::vector<Vec<Dim>> on_a;
    Vec<Dim> rest;
    double mass = 0;
    for (int q = begin; q < first_; ++q) {
      ContactPair<Dim>& pair = pairs_[q];
      const PairSide<Dim> a = side_of(groups_, pair.a), b = side_of(groups_, pair.b);
      on_a.push_back(without_axes(-respond(rules_, pair, reduced_mass(a, b), b.v - a.v).J, rules_.fixed_axes));
      rest += on_a.back();
      mass += a.m;
    }
    for (int q = begin; q < first_; ++q) {
      ContactGroup<Dim>& group = groups_[std::countr_zero(pairs_[q].a)];
      const Vec<Dim> J = on_a[static_cast<std::size_t>(q - begin)] - rest * (group.m / mass);
      group.dp += J;
      pairs_[q].J = -J;
    }
    if (rules_.task != ContactTask::four) return;
    for (int q = begin; q < first_; ++q) pairs_[q].w_end = dot(relative_velocity(pairs_[q]), pairs_[q].n);
  }

  /// Where sweeps are slow (a light field between heavy ones), solutions for the states they have found so far, and sweeps that judge
  /// them. Where nothing settles, what the first sweeps have reached is kept.
  bool help_along() {
    constexpr int most_solutions = 20, sweeps_between = 6;
    std::vector<Vec<Dim>> reached, solution, given;
    for (int q = first_; q < pair_count_; ++q) reached.push_back(pairs_[q].J);
    given.resize(static_cast<std::size_t>(group_count_));
    if (first_ > 0) {
      change_impulses(std::vector<Vec<Dim>>(reached.size()));
      for (int g = 0; g < group_count_; ++g) given[static_cast<std::size_t>(g)] = groups_[g].dp;
      change_impulses(reached);
    }
    responses_.resize(reached.size());
    sweep();
    for (int solutions = 0; solutions < most_solutions; ++solutions) {
      solve_together<Dim>(rules_.fixed_axes, groups_, group_count_, pairs_ + first_, responses_, given, solution);
      change_impulses(solution);
      for (int sweeps = 0; sweeps < sweeps_between; ++sweeps) {
        if (sweep()) return true;
      }
    }
    change_impulses(reached);
    sweep();  // states that belong to these impulses
    return false;
  }

  /// Each pair against the others as they are now. True when nothing changed.
  bool sweep() {
    double largest = momentum_, change = 0;
    for (int q = first_; q < pair_count_; ++q) {
      ContactPair<Dim>& pair = pairs_[q];
      const PairSide<Dim> a = side_of(groups_, pair.a), b = side_of(groups_, pair.b);
      const double m = reduced_mass(a, b);
      // Relative velocity as it would be without this pair's own impulse.
      const Vec<Dim> w = b.v - a.v - pair.J * (1 / m);
      const Response<Dim> response = respond(rules_, pair, m, w);
      change = std::fmax(change, change_impulse(pair, without_axes(response.J, rules_.fixed_axes), a.m, b.m));
      if (rules_.task == ContactTask::four) pair.w_end = dot(relative_velocity(pair), pair.n);  // after J
      // Round-off of J is that of the momenta it is made from, however small J itself is.
      largest = std::fmax(largest, norm(pair.J));
      if (!responses_.empty()) responses_[static_cast<std::size_t>(q - first_)] = response;
    }
    return change <= 1e-14 * largest;
  }

  Vec<Dim> relative_velocity(const ContactPair<Dim>& pair) const { return side_of(groups_, pair.b).v - side_of(groups_, pair.a).v; }

  double change_impulse(ContactPair<Dim>& pair, const Vec<Dim>& J, double mass_a, double mass_b) {
    const Vec<Dim> d = J - pair.J;
    give(groups_, pair.a, mass_a, -d);
    give(groups_, pair.b, mass_b, d);
    pair.J = J;
    return norm(d);
  }

  void change_impulses(const std::vector<Vec<Dim>>& impulses) {
    for (int q = first_; q < pair_count_; ++q) {
      change_impulse(pairs_[q], impulses[static_cast<std::size_t>(q - first_)], side_of(groups_, pairs_[q].a).m,
                     side_of(groups_, pairs_[q].b).m);
    }
  }

  const ContactRules& rules_;
  ContactGroup<Dim>* groups_;
  int group_count_;
  ContactPair<Dim>* pairs_;
  int pair_count_;
  int first_ = 0;                         ///< of the pairs that are not with a virtual material
  double momentum_ = 0;                   ///< largest about, kg m/s
  std::vector<Response<Dim>> responses_;  ///< of the last sweep, once they are wanted
};

}  // namespace

template <int Dim>
bool solve_contact(const ContactRules& rules, ContactGroup<Dim>* groups, int group_count, ContactPair<Dim>* pairs, int pair_count) {
  return NodeSolve<Dim>(rules, groups, group_count, pairs, pair_count).run();
}

template bool solve_contact<2>(const ContactRules&, ContactGroup<2>*, int, ContactPair<2>*, int);
template bool solve_contact<3>(const ContactRules&, ContactGroup<3>*, int, ContactPair<3>*, int);

}  // namespace crampon
