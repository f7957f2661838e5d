#include "crampon/contact/solve_together.hpp"

#include <Eigen/LU>

namespace crampon {

namespace {

/// One unknown: the size x of an impulse along `along`, and the condition that goes with it: the relative velocity of its pair has the
/// component `target` along `direction`.
template <int Dim>
struct Condition {
  std::size_t pair = 0;
  Vec<Dim> direction;
  double target = 0;  ///< m/s
  Vec<Dim> along;
};

/// Unit vectors across n.
std::array<Vec<2>, 1> tangents(const Vec<2>& n) { return {Vec<2>{{-n[1], n[0]}}}; }

std::array<Vec<3>, 2> tangents(const Vec<3>& n) {
  // Starts from the axis that n is farthest from.
  std::size_t k = 0;
  for (std::size_t j = 1; j < 3; ++j) {
    if (std::fabs(n[j]) < std::fabs(n[k])) k = j;
  }
  Vec<3> s;
  s[k] = 1;
  s = normalized(s - n * n[k]);
  return {s, Vec<3>{{n[1] * s[2] - n[2] * s[1], n[2] * s[0] - n[0] * s[2], n[0] * s[1] - n[1] * s[0]}}};
}

template <int Dim>
std::vector<Condition<Dim>> conditions(const ContactPair<Dim>* pairs, const std::vector<Response<Dim>>& responses) {
  std::vector<Condition<Dim>> out;
  for (std::size_t q = 0; q < responses.size(); ++q) {
    const Response<Dim>& response = responses[q];
    if (response.pushes) out.push_back({q, pairs[q].n, response.target, response.along});
    if (!response.sticks) continue;
    for (const Vec<Dim>& t : tangents(pairs[q].n)) out.push_back({q, t, 0, t});
  }
  return out;
}

}  // namespace

template <int Dim>
void solve_together(unsigned fixed_axes, const ContactGroup<Dim>* groups, int group_count, const ContactPair<Dim>* pairs,
                    const std::vector<Response<Dim>>& responses, const std::vector<Vec<Dim>>& given, std::vector<Vec<Dim>>& impulses) {
  const std::vector<Condition<Dim>> wanted = conditions(pairs, responses);
  const Eigen::Index velocities = Eigen::Index{Dim} * group_count, size = velocities + static_cast<Eigen::Index>(wanted.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  double mass = 0;
  for (int g = 0; g < group_count; ++g) mass += groups[g].rigid ? 0 : groups[g].m;
  // Momentum of each group, over the node's mass; impulses are unknown over the node's mass too. A rigid body's velocity is known. What
  // was given before (to virtual materials) stays.
  for (int g = 0; g < group_count; ++g) {
    const ContactGroup<Dim>& group = groups[g];
    for (int k = 0; k < Dim; ++k) {
      const Eigen::Index row = Eigen::Index{Dim} * g + k;
      matrix(row, row) = group.rigid ? 1 : group.m / mass;
      right(row) = group.rigid ? group.p[k] / group.m : (group.p[k] + given[static_cast<std::size_t>(g)][k]) / mass;
    }
  }
  // Shares an impulse among the groups of a side by mass.
  const auto share = [&](GroupSet set, auto f) {
    const double whole = side_of(groups, set).m;
    for_groups(set, [&](int g) { f(g, std::has_single_bit(set) ? 1. : groups[g].m / whole); });
  };
  const auto push = [&](const ContactPair<Dim>& pair, const Vec<Dim>& impulse, auto add) {
    share(pair.a, [&](int g, double part) {
      for (int k = 0; k < Dim && !groups[g].rigid; ++k) add(Eigen::Index{Dim} * g + k, -part * impulse[k]);
    });
    share(pair.b, [&](int g, double part) {
      for (int k = 0; k < Dim && !groups[g].rigid; ++k) add(Eigen::Index{Dim} * g + k, part * impulse[k]);
    });
  };
  for (std::size_t q = 0; q < responses.size(); ++q) {
    push(pairs[q], without_axes(responses[q].aside, fixed_axes), [&](Eigen::Index row, double p) { right(row) += p / mass; });
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Condition<Dim>& c = wanted[i];
    const ContactPair<Dim>& pair = pairs[c.pair];
    const Eigen::Index row = velocities + static_cast<Eigen::Index>(i);
    const Vec<Dim> applied = without_axes(c.along, fixed_axes);
    push(pair, applied, [&](Eigen::Index of, double p) { matrix(of, row) -= p; });
    for (int k = 0; k < Dim; ++k) {
      share(pair.a, [&](int g, double part) { matrix(row, Eigen::Index{Dim} * g + k) -= part * c.direction[k]; });
      share(pair.b, [&](int g, double part) { matrix(row, Eigen::Index{Dim} * g + k) += part * c.direction[k]; });
    }
    // A pair reckons as if its whole impulse acted; prescribed components then take no part of it (N13 sec. 2.5).
    const PairSide<Dim> a = side_of(groups, pair.a), b = side_of(groups, pair.b);
    matrix(row, row) += dot(c.direction, c.along - applied) * mass / reduced_mass(a, b);
    const Vec<Dim> held = responses[c.pair].aside - without_axes(responses[c.pair].aside, fixed_axes);
    right(row) = c.target - dot(c.direction, held) / reduced_mass(a, b);
  }
  const Eigen::VectorXd solution = matrix.fullPivLu().solve(right);
  impulses.clear();
  for (const Response<Dim>& response : responses) impulses.push_back(without_axes(response.aside, fixed_axes));
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    impulses[wanted[i].pair] += without_axes(wanted[i].along, fixed_axes) * (mass * solution(velocities + static_cast<Eigen::Index>(i)));
  }
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                                         \
  template void solve_together<DIM>(unsigned, const ContactGroup<DIM>*, int, const ContactPair<DIM>*, const std::vector<Response<DIM>>&, \
                                    const std::vector<Vec<DIM>>&, std::vector<Vec<DIM>>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
