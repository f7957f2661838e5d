#include "crampon/contact/node_solve.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/contact/solve_together.hpp"

namespace crampon {

namespace {

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
    responses_.resize(static_cast<std::size_t>(pair_count_));
    for (int sweeps = 1; sweeps <= most_sweeps; ++sweeps) {
      if (sweep()) return true;
      if (sweeps % sweeps_between_solves == 0) {
        solve_together<Dim>(rules_.fixed_axes, groups_, group_count_, pairs_, responses_, impulses_);
        for (int q = 0; q < pair_count_; ++q) change_impulse(pairs_[q], impulses_[static_cast<std::size_t>(q)]);
      }
    }
    return false;
  }

 private:
  static constexpr int most_sweeps = 200;
  static constexpr int sweeps_between_solves = 6;

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
      const Response<Dim> response =
          rules_.literal ? literal_response(rules_, law, pair, m, w) : consistent_response(rules_, law, pair, m, w);
      change = std::fmax(change, change_impulse(pair, without_axes(response.J, rules_.fixed_axes)));
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

  const ContactRules& rules_;
  const std::vector<ContactLawSpec>& laws_;
  ContactGroup<Dim>* groups_;
  int group_count_;
  ContactPair<Dim>* pairs_;
  int pair_count_;
  std::vector<Response<Dim>> responses_;  ///< of the last sweep
  std::vector<Vec<Dim>> impulses_;        ///< kg m/s, of the last common solution
};

}  // namespace

template <int Dim>
bool solve_contact(const ContactRules& rules, const std::vector<ContactLawSpec>& laws, ContactGroup<Dim>* groups, int group_count,
                   ContactPair<Dim>* pairs, int pair_count) {
  const bool converged = NodeSolve<Dim>(rules, laws, groups, group_count, pairs, pair_count).run();
  if (rules.task == ContactTask::four) {
    for (int q = 0; q < pair_count; ++q) pairs[q].w_end = dot(relative_velocity(groups, pairs[q]), pairs[q].n);
  }
  return converged;
}

template bool solve_contact<2>(const ContactRules&, const std::vector<ContactLawSpec>&, ContactGroup<2>*, int, ContactPair<2>*, int);
template bool solve_contact<3>(const ContactRules&, const std::vector<ContactLawSpec>&, ContactGroup<3>*, int, ContactPair<3>*, int);

}  // namespace crampon
