#include "crampon/contact/node_solve.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace crampon {

namespace {

/// Tangential impulse that a law can carry against a normal impulse N >= 0, when sticking would take `stick` (contact.md 3, 4).
double tangential_impulse(const ContactLawSpec& law, double N, double stick) {
  return std::visit(
      [&](const auto& l) -> double {
        using Law = std::decay_t<decltype(l)>;
        if constexpr (std::is_same_v<Law, CoulombContact>) {
          return std::min(stick, l.friction * N);
        } else if constexpr (std::is_same_v<Law, StickContact> || std::is_same_v<Law, BondedContact>) {
          return stick;
        } else {
          return 0.;
        }
      },
      law);
}

bool may_stick(const ContactLawSpec& law) {
  return std::holds_alternative<CoulombContact>(law) || std::holds_alternative<StickContact>(law);
}

/// Impulse on b from a normal impulse D_n (along n, negative closes: then b is pushed along +n) and the law's share of the
/// tangential one. D = m_red (v_b - v_a) is the stick impulse on a.
template <int Dim>
Vec<Dim> impulse_on_b(const ContactLawSpec& law, const Vec<Dim>& n, double normal, const Vec<Dim>& D_t, bool& sticks) {
  const double stick = norm(D_t);
  const double carried = tangential_impulse(law, std::fabs(normal), stick);
  sticks = may_stick(law) && carried >= stick;
  Vec<Dim> J = n * normal;
  if (stick > 0) J -= D_t * (carried / stick);
  return J;
}

/// The papers' rule, anew in each task (N03 section 2.2, N13 section 3).
template <int Dim>
Vec<Dim> literal_impulse(const ContactRules& rules, const ContactLawSpec& law, const ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
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
  if (!touching || w_n == 0) return {};
  bool sticks = false;
  return impulse_on_b(law, pair.n, -m * w_n, (w - pair.n * w_n) * m, sticks);
}

/// The lagged, consistent active set (contact-consistency.md, "The scheme").
template <int Dim>
Vec<Dim> consistent_impulse(const ContactRules& rules, const ContactLawSpec& law, ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
  const double w_n = dot(w, pair.n);
  const Vec<Dim> D_t = (w - pair.n * w_n) * m;
  const double gap = pair.previous == ContactState::open ? pair.gap : std::fmin(pair.gap, 0.);
  const double bound = -std::fmax(gap, 0.) / rules.dt;
  const auto hold = [&](double target, ContactState state) {
    Vec<Dim> J = pair.n * (m * (target - w_n));
    if (state == ContactState::stick) J -= D_t;
    return J;
  };
  switch (rules.task) {
    case ContactTask::two:
      if (pair.previous != ContactState::open) return hold(0., pair.previous);
      break;
    case ContactTask::four:
      break;
    case ContactTask::six:
      if (pair.state == ContactState::open) return {};
      return hold(std::fmin(0., std::fmax(w_n, std::fmin(pair.w_end, 0.))), pair.state);
  }
  ContactState found = ContactState::open;
  Vec<Dim> J;
  if (w_n < bound) {
    bool sticks = false;
    J = impulse_on_b(law, pair.n, m * (bound - w_n), D_t, sticks);
    found = sticks ? ContactState::stick : ContactState::slip;
  }
  if (rules.task == ContactTask::four) pair.state = found;
  return J;
}

template <int Dim>
Vec<Dim> relative_velocity(const ContactGroup<Dim>* groups, const ContactPair<Dim>& pair) {
  const ContactGroup<Dim>&a = groups[pair.a], &b = groups[pair.b];
  return (b.p + b.dp) * (1 / b.m) - (a.p + a.dp) * (1 / a.m);
}

}  // namespace

template <int Dim>
bool solve_contact(const ContactRules& rules, const std::vector<ContactLawSpec>& laws, ContactGroup<Dim>* groups, int group_count,
                   ContactPair<Dim>* pairs, int pair_count) {
  for (int g = 0; g < group_count; ++g) groups[g].dp = {};
  for (int q = 0; q < pair_count; ++q) pairs[q].J = {};
  const int sweeps = pair_count == 1 || rules.sequential ? 1 : 200;
  bool converged = sweeps == 1;
  for (int sweep = 0; sweep < sweeps && !(converged && sweep > 0); ++sweep) {
    double largest = 0, change = 0;
    for (int q = 0; q < pair_count; ++q) {
      ContactPair<Dim>& pair = pairs[q];
      ContactGroup<Dim>&a = groups[pair.a], &b = groups[pair.b];
      const double m = a.m * b.m / (a.m + b.m);
      // Relative velocity as it would be without this pair's own impulse.
      const Vec<Dim> w = relative_velocity(groups, pair) - pair.J * (1 / m);
      const ContactLawSpec& law = laws[pair.crack];
      Vec<Dim> J = rules.literal ? literal_impulse(rules, law, pair, m, w) : consistent_impulse(rules, law, pair, m, w);
      for (int k = 0; k < Dim; ++k) {
        if (rules.fixed_axes >> k & 1u) J[k] = 0;
      }
      const Vec<Dim> d = J - pair.J;
      a.dp -= d;
      b.dp += d;
      pair.J = J;
      change = std::fmax(change, norm(d));
      // Round-off of J is that of the momenta it is made from, however small J itself is.
      largest = std::fmax(largest, std::fmax(norm(J), m * (norm(a.p) / a.m + norm(b.p) / b.m)));
    }
    if (sweeps > 1) converged = change <= 1e-14 * largest;
  }
  if (rules.task == ContactTask::four) {
    for (int q = 0; q < pair_count; ++q) pairs[q].w_end = dot(relative_velocity(groups, pairs[q]), pairs[q].n);
  }
  return converged;
}

template bool solve_contact<2>(const ContactRules&, const std::vector<ContactLawSpec>&, ContactGroup<2>*, int, ContactPair<2>*, int);
template bool solve_contact<3>(const ContactRules&, const std::vector<ContactLawSpec>&, ContactGroup<3>*, int, ContactPair<3>*, int);

}  // namespace crampon
