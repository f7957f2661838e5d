#include "crampon/contact/outline_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace crampon {

namespace {

constexpr double gap_start = -std::numeric_limits<double>::infinity();
/// Leaves the gap between two staircases of particles too small by a few hundredths of a particle.
constexpr int closest_steps = 12;

/// A corner this far outside the surface, as a part of the depth of the particle that knows it, is on it.
constexpr double cut_off = 1e-6;

/// Direction of the side of a box across its edge `axis`.
Vec<2> side_normal(const std::array<Vec<2>, 2>& edges, std::size_t axis) {
  const Vec<2>& along = edges[1 - axis];
  return {{along[1], -along[0]}};
}
Vec<3> side_normal(const std::array<Vec<3>, 3>& edges, std::size_t axis) {
  const Vec<3>&s = edges[(axis + 1) % 3], &t = edges[(axis + 2) % 3];
  return {{s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]}};
}

/// A plane that bounds a body where its surface is known: unit normal, and the point of it nearest to a particle.
template <int Dim>
struct Bound {
  Vec<Dim> out, at;
  double depth;  ///< of the particle behind it, m
};

/// Points that show how far a body reaches: those of its surface, and corners of particles that no part of the surface cuts off.
template <int Dim>
std::vector<Vec<Dim>> outline_of(std::span<const OutlinedParticle<Dim>> particles, ContactSide side) {
  std::vector<Vec<Dim>> points;
  std::vector<Bound<Dim>> bounds;
  for (const OutlinedParticle<Dim>& p : particles) {
    const double depth = norm(p.to_surface);
    if (p.side != side || !(depth > 0)) continue;
    points.push_back(p.x + p.to_surface);
    bounds.push_back({p.to_surface * (1 / depth), points.back(), depth});
  }
  for (const OutlinedParticle<Dim>& p : particles) {
    if (p.side != side) continue;
    const double depth = norm(p.to_surface);
    for (unsigned c = 0; c < 1u << Dim; ++c) {
      Vec<Dim> corner = p.x;
      for (unsigned k = 0; k < Dim; ++k) corner += p.half_edges[k] * (c >> k & 1u ? 1. : -1.);
      if (depth > 0) {  // what sticks out of its own piece of the surface is cut off
        const Vec<Dim> out = p.to_surface * (1 / depth);
        corner -= out * std::fmax(0., dot(out, corner - p.x) - depth);
      }
      const bool within =
          std::all_of(bounds.begin(), bounds.end(), [&](const Bound<Dim>& b) { return dot(b.out, corner - b.at) <= cut_off * b.depth; });
      if (within) points.push_back(corner);
    }
  }
  return points;
}

}  // namespace

template <int Dim>
double outline_gap(std::span<const OutlinedParticle<Dim>> particles, std::span<const Vec<Dim>> directions) {
  struct Body {
    std::array<Vec<Dim>, Dim> edges{};
    Vec<Dim> x;
    double weight = 0;
  } a, b;
  for (const OutlinedParticle<Dim>& p : particles) {
    Body& body = p.side == ContactSide::a ? a : b;
    for (std::size_t k = 0; k < Dim; ++k) body.edges[k] += p.half_edges[k] * p.weight;
    body.x += p.x * p.weight;
    body.weight += p.weight;
  }
  if (!(a.weight > 0 && b.weight > 0)) return std::numeric_limits<double>::infinity();
  const Vec<Dim> to_b = b.x * (1 / b.weight) - a.x * (1 / a.weight);
  const std::vector<Vec<Dim>> of_a = outline_of(particles, ContactSide::a), of_b = outline_of(particles, ContactSide::b);
  double gap = gap_start;
  // What b shows towards a less what a shows towards b along the unit vector n, as the difference of two points.
  const auto look_along_unit = [&](const Vec<Dim>& n) {
    double end_of_a = gap_start, begin_of_b = -gap_start;
    Vec<Dim> on_a, on_b;
    for (const Vec<Dim>& x : of_a) {
      if (dot(n, x) > end_of_a) end_of_a = dot(n, x), on_a = x;
    }
    for (const Vec<Dim>& x : of_b) {
      if (dot(n, x) < begin_of_b) begin_of_b = dot(n, x), on_b = x;
    }
    gap = std::fmax(gap, begin_of_b - end_of_a);
    return on_b - on_a;
  };
  const auto look_along = [&](const Vec<Dim>& direction) {
    const Vec<Dim> n = normalized(direction);
    if (n != Vec<Dim>{}) look_along_unit(dot(n, to_b) < 0 ? -n : n);
  };
  for (const Vec<Dim>& direction : directions) look_along(direction);
  for (std::size_t k = 0; k < Dim; ++k) {
    look_along(side_normal(a.edges, k));
    look_along(side_normal(b.edges, k));
  }
  for (const OutlinedParticle<Dim>& p : particles) {
    if (norm(p.to_surface) > 0) look_along(p.to_surface);
  }
  // From the middles towards the closest points of both (Gilbert, SIAM J. Control 4 (1966) 61); each direction on the way is one to look along.
  Vec<Dim> between = to_b;
  for (int step = 0; step < closest_steps && norm(between) > 0; ++step) {
    const Vec<Dim> change = look_along_unit(normalized(between)) - between;
    const double square = dot(change, change);
    if (square == 0) break;
    between += change * std::clamp(-dot(between, change) / square, 0., 1.);
  }
  return gap;
}

template double outline_gap<2>(std::span<const OutlinedParticle<2>>, std::span<const Vec<2>>);
template double outline_gap<3>(std::span<const OutlinedParticle<3>>, std::span<const Vec<3>>);

}  // namespace crampon
