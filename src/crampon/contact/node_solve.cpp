#include "crampon/contact/node_solve.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/contact/solve_together.hpp"

namespace crampon {

namespace {

/// No detection (CONVENTIONS 44). Such pairs are there only when pairs are done one after another; else bonded fields are one group.
template <int Dim>
Response<Dim> bonded_response(const ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
  Response<Dim> out;
  const double w_n = dot(w, pair.n);
  out.push(pair.n, m, w_n, 0);
  out.stick((w - pair.n * w_n) * m);
  return out;
}

/// The papers' rule, anew in each task (N03 section 2.2, N13 section 3).
template <int Dim>
Response<Dim> literal_response(const ContactRules& rules, const ContactLawSpec& law, const ContactPair<Dim>& pair, double m,
                               const Vec<Dim>& w) {
  const double w_n = dot(w, pair.n);
  bool touching = false;
  if (rules.by_volume) {
    if (pair.volume_ratio > rules.volume_contact) {
      touching = w_n < 0 || !rules.require_approach;
    } else if (pair.volume_ratio >= rules.volume_separated) {
      touching = w_n < 0;
    }
  } else {
    touching = w_n < 0 && pair.gap + w_n * rules.dt < 0;
  }
  Response<Dim> out;
  if (!touching || w_n == 0) return out;
  out.push(pair.n, m, w_n, 0);
  out.rub(law, (w - pair.n * w_n) * m);
  return out;
}

/// The lagged, consistent active set (contact-consistency.md, "The scheme").
template <int Dim>
Response<Dim> consistent_response(const ContactRules& rules, const ContactLawSpec& law, ContactPair<Dim>& pair, double m,
                                  const Vec<Dim>& w) {
  const double w_n = dot(w, pair.n);
  const Vec<Dim> D_t = (w - pair.n * w_n) * m;
  const double gap = pair.previous == ContactState::open ? pair.gap : std::fmin(pair.gap, 0.);
  const double bound = -std::fmax(gap, 0.) / rules.dt;
  Response<Dim> out;
  const auto test = [&] {
    if (w_n >= bound) return;
    out.push(pair.n, m, w_n, bound);
    out.rub(law, D_t);
  };
  switch (rules.task) {
    case ContactTask::two:
      if (pair.previous == ContactState::open) {
        test();
      } else {
        out.push(pair.n, m, w_n, 0);
        if (pair.previous == ContactState::stick) out.stick(D_t);
      }
      break;
    case ContactTask::four:
      test();
      pair.state = !out.pushes ? ContactState::open : out.sticks ? ContactState::stick : ContactState::slip;
      break;
    case ContactTask::six: {
      if (pair.state == ContactState::open) break;
      const double least = std::fmin(pair.w_end, 0.);
      if (w_n > 0 || w_n < least) out.push(pair.n, m, w_n, w_n > 0 ? 0. : least);
      if (pair.state == ContactState::stick) out.stick(D_t);
      break;
    }
  }
  return out;
}

template <int Dim>
Vec<Dim> relative_velocity(const ContactGroup<Dim>* groups, const ContactPair<Dim>& pair) {
  const ContactGroup<Dim>&a = groups[pair.a], &b = groups[pair.b];
  return (b.p + b.dp) * (1 / b.m) - (a.p + a.dp) * (1 / a.m);
}

/// The pairs of a node, solved one by one and together.
template <int Dim>
class NodeSolve {
 public:
  NodeSolve(const ContactRules& rules, const std::vector<ContactLawSpec>& laws, ContactGroup<Dim>* groups, int group_count,
            ContactPair<Dim>* pairs, int pair_count)
      : rules_(rules), laws_(laws), groups_(groups), group_count_(group_count), pairs_(pairs), pair_count_(pair_count) {
    for (int g = 0; g < group_count; ++g) groups[g].dp = {};
    for (int q = 0; q < pair_count; ++q) pairs[q].J = {};
  }

  bool run() {
    if (pair_count_ == 1 || rules_.sequential) {
      sweep();
      return true;
    }
    for (int sweeps = 0; sweeps < most_sweeps; ++sweeps) {
      if (sweep()) return true;
    }
    return help_along();
  }

 private:
  static constexpr int most_sweeps = 200;  // CONVENTIONS 13

  /// Where sweeps are slow (a light field between heavy ones), solutions for the states they have found so far, and sweeps that judge
  /// them. Where nothing settles, what the first sweeps have reached is kept.
  bool help_along() {
    constexpr int most_solutions = 20, sweeps_between = 6;
    std::vector<Vec<Dim>> reached, solution;
    for (int q = 0; q < pair_count_; ++q) reached.push_back(pairs_[q].J);
    responses_.resize(static_cast<std::size_t>(pair_count_));
    sweep();
    for (int solutions = 0; solutions < most_solutions; ++solutions) {
      solve_together<Dim>(rules_.fixed_axes, groups_, group_count_, pairs_, responses_, solution);
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
    double largest = 0, change = 0;
    for (int q = 0; q < pair_count_; ++q) {
      ContactPair<Dim>& pair = pairs_[q];
      const ContactGroup<Dim>&a = groups_[pair.a], &b = groups_[pair.b];
      const double m = a.m * b.m / (a.m + b.m);
      // Relative velocity as it would be without this pair's own impulse.
      const Vec<Dim> w = relative_velocity(groups_, pair) - pair.J * (1 / m);
      const ContactLawSpec& law = laws_[pair.crack];
      const Response<Dim> response = std::holds_alternative<BondedContact>(law) ? bonded_response(pair, m, w)
                                     : rules_.literal                           ? literal_response(rules_, law, pair, m, w)
                                                                                : consistent_response(rules_, law, pair, m, w);
      change = std::fmax(change, change_impulse(pair, without_axes(response.J, rules_.fixed_axes)));
      if (rules_.task == ContactTask::four) pair.w_end = dot(relative_velocity(groups_, pair), pair.n);  // contact-consistency.md: after J
      // Round-off of J is that of the momenta it is made from, however small J itself is.
      largest = std::fmax(largest, std::fmax(norm(pair.J), m * (norm(a.p) / a.m + norm(b.p) / b.m)));
      if (!responses_.empty()) responses_[static_cast<std::size_t>(q)] = response;
    }
    return change <= 1e-14 * largest;
  }

  double change_impulse(ContactPair<Dim>& pair, const Vec<Dim>& J) {
    const Vec<Dim> d = J - pair.J;
    groups_[pair.a].dp -= d;
    groups_[pair.b].dp += d;
    pair.J = J;
    return norm(d);
  }

  void change_impulses(const std::vector<Vec<Dim>>& impulses) {
    for (int q = 0; q < pair_count_; ++q) change_impulse(pairs_[q], impulses[static_cast<std::size_t>(q)]);
  }

  const ContactRules& rules_;
  const std::vector<ContactLawSpec>& laws_;
  ContactGroup<Dim>* groups_;
  int group_count_;
  ContactPair<Dim>* pairs_;
  int pair_count_;
  std::vector<Response<Dim>> responses_;  ///< of the last sweep, once they are wanted
};

}  // namespace

template <int Dim>
bool solve_contact(const ContactRules& rules, const std::vector<ContactLawSpec>& laws, ContactGroup<Dim>* groups, int group_count,
                   ContactPair<Dim>* pairs, int pair_count) {
  return NodeSolve<Dim>(rules, laws, groups, group_count, pairs, pair_count).run();
}

template bool solve_contact<2>(const ContactRules&, const std::vector<ContactLawSpec>&, ContactGroup<2>*, int, ContactPair<2>*, int);
template bool solve_contact<3>(const ContactRules&, const std::vector<ContactLawSpec>&, ContactGroup<3>*, int, ContactPair<3>*, int);

}  // namespace crampon
