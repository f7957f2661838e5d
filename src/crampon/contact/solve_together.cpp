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
                    const std::vector<Response<Dim>>& responses, std::vector<Vec<Dim>>& impulses) {
  const std::vector<Condition<Dim>> wanted = conditions(pairs, responses);
  const Eigen::Index velocities = Eigen::Index{Dim} * group_count, size = velocities + static_cast<Eigen::Index>(wanted.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  double mass = 0;
  for (int g = 0; g < group_count; ++g) mass += groups[g].m;
  // Momentum of each group, over the node's mass; impulses are unknown over the node's mass too.
  for (int g = 0; g < group_count; ++g) {
    for (int k = 0; k < Dim; ++k) {
      const Eigen::Index row = Eigen::Index{Dim} * g + k;
      matrix(row, row) = groups[g].m / mass;
      right(row) = groups[g].p[k] / mass;
    }
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Condition<Dim>& c = wanted[i];
    const ContactPair<Dim>& pair = pairs[c.pair];
    const Eigen::Index row = velocities + static_cast<Eigen::Index>(i), a = Eigen::Index{Dim} * pair.a, b = Eigen::Index{Dim} * pair.b;
    const Vec<Dim> applied = without_axes(c.along, fixed_axes);
    for (int k = 0; k < Dim; ++k) {
      matrix(a + k, row) += applied[k];
      matrix(b + k, row) -= applied[k];
      matrix(row, a + k) -= c.direction[k];
      matrix(row, b + k) += c.direction[k];
    }
    // A pair reckons as if its whole impulse acted; prescribed components then take no part of it (N13 sec. 2.5).
    matrix(row, row) += dot(c.direction, c.along - applied) * mass * (1 / groups[pair.a].m + 1 / groups[pair.b].m);
    right(row) = c.target;
  }
  const Eigen::VectorXd solution = matrix.fullPivLu().solve(right);
  impulses.assign(responses.size(), Vec<Dim>{});
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    impulses[wanted[i].pair] += without_axes(wanted[i].along, fixed_axes) * (mass * solution(velocities + static_cast<Eigen::Index>(i)));
  }
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                                         \
  template void solve_together<DIM>(unsigned, const ContactGroup<DIM>*, int, const ContactPair<DIM>*, const std::vector<Response<DIM>>&, \
                                    std::vector<Vec<DIM>>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
