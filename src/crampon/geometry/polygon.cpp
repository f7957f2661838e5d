#include "crampon/geometry/polygon.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "crampon/core/predicates.hpp"
#include "crampon/geometry/direction.hpp"

namespace crampon {
namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();

Corners opened(Corners loop) {
  if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  return loop;
}

// Relative to the first corner: a small polygon far from the origin keeps its digits.
double loop_area(const Corners& loop) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) twice += cross(loop[k] - loop[0], loop[k + 1] - loop[0]);
  return std::abs(twice) / 2;
}

bool between(const Vec<2>& a, const Vec<2>& b, const Vec<2>& x) {
  return x[0] >= std::min(a[0], b[0]) && x[0] <= std::max(a[0], b[0]) && x[1] >= std::min(a[1], b[1]) && x[1] <= std::max(a[1], b[1]);
}

enum class Place { outside, on_edge, inside };

// Flips `inside` when the ray from x towards +x passes the edge; each edge owns its lower end, so a corner counts once.
Place pass_edge(const Vec<2>& a, const Vec<2>& b, const Vec<2>& x, Place place) {
  if (place == Place::on_edge) return place;
  const bool a_above = a[1] > x[1], b_above = b[1] > x[1];
  const bool straddles = a_above != b_above;
  if (!straddles && !between(a, b, x)) return place;
  const int turn = orient_sign(a, b, x);
  if (turn == 0 && between(a, b, x)) return Place::on_edge;
  const bool passes = straddles && (b_above ? turn > 0 : turn < 0);
  if (!passes) return place;
  return place == Place::inside ? Place::outside : Place::inside;
}

Place place_in(const Corners& loop, const Vec<2>& x) {
  Place place = Place::outside;
  for (std::size_t k = 0; k < loop.size(); ++k) place = pass_edge(loop[k], loop[(k + 1) % loop.size()], x, place);
  return place;
}

double distance2_to_edge(const Vec<2>& a, const Vec<2>& b, const Vec<2>& x) {
  const Vec<2> along = b - a, r = x - a;
  const double t = std::clamp(dot(along, r) / dot(along, along), 0., 1.);
  const Vec<2> off = r - t * along;
  return dot(off, off);
}

// Exact, at a corner that every loop bends at: the leftmost (the lowest of these).
bool counter_clockwise(const Corners& loop) {
  const std::size_t n = loop.size();
  std::size_t k = 0;
  for (std::size_t j = 1; j < n; ++j)
    if (loop[j].c < loop[k].c) k = j;
  return orient_sign(loop[(k + n - 1) % n], loop[k], loop[(k + 1) % n]) > 0;
}

bool edges_touch(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d) {
  for (int k = 0; k < 2; ++k)
    if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k])) return false;
  const int c_side = orient_sign(a, b, c), d_side = orient_sign(a, b, d);
  const int a_side = orient_sign(c, d, a), b_side = orient_sign(c, d, b);
  // Boxes overlap; then the segments meet unless one lies strictly on one side of the other's line.
  return c_side * d_side <= 0 && a_side * b_side <= 0;
}

std::string edge_name(std::size_t k) { return fmt::format("the edge from corner {}", k + 1); }

// First fault of a loop by itself; empty when it is a simple polygon.
std::string loop_fault(const Corners& loop) {
  const std::size_t n = loop.size();
  if (n < 3) return fmt::format("has {} corner{}, an area needs at least 3", n, n == 1 ? "" : "s");
  for (std::size_t k = 0; k < n; ++k)
    if (loop[k] == loop[(k + 1) % n]) return fmt::format("repeats corner {}", k + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<2>&a = loop[i], &b = loop[(i + 1) % n];
    const Vec<2>& next = loop[(i + 2) % n];
    if (orient_sign(a, b, next) == 0 && dot(b - a, next - b) < 0) return fmt::format("folds back on itself at corner {}", (i + 1) % n + 1);
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      if (edges_touch(a, b, loop[j], loop[(j + 1) % n])) return fmt::format("crosses itself: {} meets {}", edge_name(i), edge_name(j));
    }
  }
  return {};
}

bool loops_touch(const Corners& one, const Corners& other) {
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t j = 0; j < other.size(); ++j)
      if (edges_touch(one[i], one[(i + 1) % one.size()], other[j], other[(j + 1) % other.size()])) return true;
  return false;
}
}  // namespace

Polygon::Polygon(Corners outer, std::vector<Corners> holes)
    : bounds_{{{infinity, infinity, -infinity}}, {{-infinity, -infinity, infinity}}} {
  outer = opened(std::move(outer));
  add_loop(outer, false);
  area_ = loop_area(outer);
  for (const Vec<2>& corner : outer) {
    for (int k = 0; k < 2; ++k) {
      bounds_.low[k] = std::min(bounds_.low[k], corner[k]);
      bounds_.high[k] = std::max(bounds_.high[k], corner[k]);
    }
  }
  for (Corners& hole : holes) {
    hole = opened(std::move(hole));
    add_loop(hole, true);
    area_ -= loop_area(hole);
  }
}

double Polygon::distance(const Vec<3>& x) const {
  const Vec<2> p{{x[0], x[1]}};
  Place place = Place::outside;
  double distance2 = infinity;
  for (const Edge& edge : edges_) {
    // Holes flip the parity back: one walk over all loops.
    place = pass_edge(edge.from, edge.to, p, place);
    distance2 = std::min(distance2, distance2_to_edge(edge.from, edge.to, p));
  }
  if (place == Place::on_edge) return 0;
  // Off the edges the distance may still round to zero; the sign must survive for containment.
  const double positive = std::max(std::sqrt(distance2), std::numeric_limits<double>::denorm_min());
  return place == Place::inside ? -positive : positive;
}

void Polygon::add_loop(const Corners& loop, bool hole) {
  const std::size_t n = loop.size(), first = edges_.size();
  const double side = counter_clockwise(loop) == hole ? -1 : 1;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec<2> along = unit_along(loop[(k + 1) % n] - loop[k]);
    edges_.push_back({loop[k], loop[(k + 1) % n], side * Vec<2>{{along[1], -along[0]}}});
  }
  for (std::size_t k = 0; k < n; ++k) {
    edges_[first + k].normal_before = edges_[first + (k + n - 1) % n].normal;
    edges_[first + k].normal_after = edges_[first + (k + 1) % n].normal;
  }
}

Vec<3> Polygon::outward(const Vec<3>& x) const {
  const Vec<2> p{{x[0], x[1]}};
  Place place = Place::outside;
  double distance2 = infinity;
  const Edge* nearest = nullptr;
  for (const Edge& edge : edges_) {
    place = pass_edge(edge.from, edge.to, p, place);
    const double other = distance2_to_edge(edge.from, edge.to, p);
    if (other < distance2) {
      distance2 = other;
      nearest = &edge;
    }
  }
  const auto& [from, to, normal, before, after] = *nearest;
  // Beyond an end the corner is nearest: seen from outside where the boundary is convex, from inside where it is not.
  const double side = place == Place::inside ? -1 : 1;
  if (dot(to - from, p - from) <= 0) return in_plane(between_normals(side * unit_along(p - from), normal, before));
  if (dot(to - from, p - to) >= 0) return in_plane(between_normals(side * unit_along(p - to), normal, after));
  return in_plane(normal);
}

std::vector<PolygonFault> find_polygon_faults(const Corners& outer, const std::vector<Corners>& holes) {
  std::vector<PolygonFault> faults;
  const auto add = [&](int loop, std::string what) {
    PolygonFault& fault = faults.emplace_back();
    fault.loop = loop;
    fault.what = std::move(what);
  };
  const auto check = [&](int loop, const Corners& corners) {
    if (std::string what = loop_fault(corners); !what.empty()) add(loop, std::move(what));
  };
  std::vector<Corners> loops;
  loops.push_back(opened(outer));
  for (const Corners& hole : holes) loops.push_back(opened(hole));
  for (std::size_t k = 0; k < loops.size(); ++k) check(static_cast<int>(k) - 1, loops[k]);
  if (!faults.empty()) return faults;
  for (std::size_t k = 1; k < loops.size(); ++k) {
    const int hole = static_cast<int>(k) - 1;
    if (loops_touch(loops[0], loops[k]))
      add(hole, "touches or crosses the outer boundary");
    else if (place_in(loops[0], loops[k][0]) != Place::inside)
      add(hole, "lies outside the polygon");
    for (std::size_t j = 1; j < k; ++j) {
      if (loops_touch(loops[j], loops[k]))
        add(hole, fmt::format("touches or crosses hole {}", j));
      else if (place_in(loops[j], loops[k][0]) == Place::inside || place_in(loops[k], loops[j][0]) == Place::inside)
        add(hole, fmt::format("and hole {} lie inside one another", j));
    }
  }
  return faults;
}

}  // namespace crampon
