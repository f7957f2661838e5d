#include "crampon/geometry/round.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "crampon/geometry/angle.hpp"
#include "crampon/geometry/direction.hpp"

namespace crampon {
namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

Vec<2> from_centre(const Vec<2>& centre, const Vec<3>& x) { return {{x[0] - centre[0], x[1] - centre[1]}}; }
double distance_from(const Vec<2>& centre, const Vec<3>& x) { return std::hypot(x[0] - centre[0], x[1] - centre[1]); }

Bounds3 bounds_around(const Vec<2>& centre, double half_width, double half_height) {
  return {{{centre[0] - half_width, centre[1] - half_height, -infinity}}, {{centre[0] + half_width, centre[1] + half_height, infinity}}};
}

struct EllipseFoot {
  double distance;
  Vec<2> normal;  // of the ellipse there, of any length
};

// Point of the ellipse with semi-axes a >= b that is nearest to (u, v), u, v >= 0. The foot of the perpendicular is (a^2 u/(t+a^2), b^2 v/(t+b^2))
// for the root t > -b^2 of F(t) = (a u/(t+a^2))^2 + (b v/(t+b^2))^2 - 1. F falls and is convex there, so Newton from a point left of the
// root climbs to it without overshooting. Here w = t/b^2 + 1, which keeps its digits near the centre.
EllipseFoot nearest_on_ellipse(double a, double b, double u, double v) {
  if (v == 0) {
    // Foot on the curve while u lies inside the evolute's cusp, else at the vertex.
    const double cusp = (a * a - b * b) / a;
    if (u >= cusp) return {std::abs(u - a), {{1, 0}}};
    const double foot = u * a / (a * a - b * b);  // cosine of the foot's parameter
    const double sine = std::sqrt(1 - foot * foot);
    return {std::hypot(u - a * foot, b * sine), {{foot * (b / a), sine}}};
  }
  if (u == 0) return {std::abs(v - b), {{0, 1}}};
  const double ratio2 = (a / b) * (a / b), p = (a / b) * (u / b), q = v / b;
  double w = std::max(q, p - (ratio2 - 1));  // one of the two squares is 1, the other at most 1: left of the root
  for (int k = 0; k < 100; ++k) {
    const double f = p / (w + (ratio2 - 1)), g = q / w;
    const double value = f * f + g * g - 1;
    const double slope = -2 * (f * f / (w + (ratio2 - 1)) + g * g / w);
    const double next = w - value / slope;
    if (!(next > w)) break;
    w = next;
  }
  return {std::hypot(u - ratio2 * u / (w + (ratio2 - 1)), v - v / w), {{u / (w + (ratio2 - 1)), v / w}}};
}
}  // namespace

double Disk::distance(const Vec<3>& x) const { return distance_from(centre, x) - radius; }
Vec<3> Disk::outward(const Vec<3>& x) const { return in_plane(unit_along(from_centre(centre, x))); }
Bounds3 Disk::bounds() const { return bounds_around(centre, radius, radius); }
std::optional<double> Disk::measure() const { return pi * radius * radius; }

Ellipse::Ellipse(const Vec<2>& centre, const Vec<2>& semi_axes, double angle)
    : centre_(centre), semi_axes_(semi_axes), direction_(direction_of(angle)) {}

Vec<2> Ellipse::to_axes(const Vec<3>& x) const {
  const Vec<2> r = from_centre(centre_, x);
  return {{dot(direction_, r), cross(direction_, r)}};
}

double Ellipse::distance(const Vec<3>& x) const {
  const Vec<2> r = to_axes(x);
  const auto [a, b] = semi_axes_.c;
  const double u = std::abs(r[0]), v = std::abs(r[1]);
  const double unsigned_distance = (a >= b ? nearest_on_ellipse(a, b, u, v) : nearest_on_ellipse(b, a, v, u)).distance;
  return std::hypot(u / a, v / b) <= 1 ? -unsigned_distance : unsigned_distance;
}

Vec<3> Ellipse::outward(const Vec<3>& x) const {
  const Vec<2> r = to_axes(x);
  const auto [a, b] = semi_axes_.c;
  const double u = std::abs(r[0]), v = std::abs(r[1]);
  Vec<2> n = unit_along((a >= b ? nearest_on_ellipse(a, b, u, v) : nearest_on_ellipse(b, a, v, u)).normal);
  if (a < b) std::swap(n[0], n[1]);
  for (std::size_t k = 0; k < 2; ++k)
    if (r[k] < 0) n[k] = -n[k];
  return {{n[0] * direction_[0] - n[1] * direction_[1], n[0] * direction_[1] + n[1] * direction_[0], 0}};
}

bool Ellipse::contains(const Vec<3>& x, double slack) const {
  if (slack >= 0) {
    const Vec<2> r = to_axes(x);
    const double scaled = std::hypot(r[0] / semi_axes_[0], r[1] / semi_axes_[1]);
    if (scaled <= 1) return true;
    // A step of length d changes `scaled` by at most d / (smaller semi-axis).
    if ((scaled - 1) * std::min(semi_axes_[0], semi_axes_[1]) > slack) return false;
  }
  return distance(x) <= slack;
}

Bounds3 Ellipse::bounds() const {
  const auto [a, b] = semi_axes_.c;
  const auto [c, s] = direction_.c;
  return bounds_around(centre_, std::hypot(a * c, b * s), std::hypot(a * s, b * c));
}

std::optional<double> Ellipse::measure() const { return pi * semi_axes_[0] * semi_axes_[1]; }

double Ring::distance(const Vec<3>& x) const {
  const double r = distance_from(centre, x);
  return std::max(r - outer, inner - r);
}
Vec<3> Ring::outward(const Vec<3>& x) const {
  const Vec<2> r = from_centre(centre, x);
  const double length = distance_from(centre, x);
  return in_plane(length - outer >= inner - length ? unit_along(r) : -unit_along(r));
}
Bounds3 Ring::bounds() const { return bounds_around(centre, outer, outer); }
std::optional<double> Ring::measure() const { return pi * (outer - inner) * (outer + inner); }

Sector::Sector(const Vec<2>& centre, double radius, double from, double to)
    : centre_(centre), radius_(radius), from_(from), to_(to), from_edge_(direction_of(from)), to_edge_(direction_of(to)) {}

// Whether a direction from the centre lies within the slice.
bool Sector::between_edges(const Vec<2>& r) const {
  const bool after_from = cross(from_edge_, r) >= 0, before_to = cross(r, to_edge_) >= 0;
  return to_ - from_ <= pi ? after_from && before_to : after_from || before_to;
}

bool Sector::whole() const { return to_ - from_ >= 2 * pi * (1 - 1e-15); }

double Sector::distance_to_edge(const Vec<2>& edge, const Vec<2>& r) const {
  return norm(r - std::clamp(dot(edge, r), 0., radius_) * edge);
}

double Sector::distance(const Vec<3>& x) const {
  const Vec<2> r = from_centre(centre_, x);
  const double to_arc = norm(r) - radius_;
  if (whole()) return to_arc;
  const double to_edges = std::min(distance_to_edge(from_edge_, r), distance_to_edge(to_edge_, r));
  if (!between_edges(r)) return to_edges;
  return to_arc <= 0 ? std::max(to_arc, -to_edges) : to_arc;
}

Vec<3> Sector::outward(const Vec<3>& x) const {
  const Vec<2> r = from_centre(centre_, x);
  const double to_arc = norm(r) - radius_;
  if (whole()) return in_plane(unit_along(r));
  const double to_from = distance_to_edge(from_edge_, r), to_to = distance_to_edge(to_edge_, r);
  const bool within = between_edges(r);
  if (within && (to_arc > 0 || to_arc >= -std::min(to_from, to_to))) return in_plane(unit_along(r));
  const Vec<2> from_normal{{from_edge_[1], -from_edge_[0]}}, to_normal{{-to_edge_[1], to_edge_[0]}};
  const Vec<2>&edge = to_from <= to_to ? from_edge_ : to_edge_, &normal = to_from <= to_to ? from_normal : to_normal;
  const double along = dot(edge, r);
  if (along <= 0) return in_plane(between_normals(within ? -unit_along(r) : unit_along(r), from_normal, to_normal));
  if (along >= radius_) return in_plane(between_normals(unit_along(r - radius_ * edge), normal, edge));
  return in_plane(normal);
}

Bounds3 Sector::bounds() const {
  Vec<2> low = centre_, high = centre_;
  const auto include = [&](const Vec<2>& direction) {
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], centre_[k] + radius_ * direction[k]);
      high[k] = std::max(high[k], centre_[k] + radius_ * direction[k]);
    }
  };
  include(from_edge_);
  include(to_edge_);
  for (double quarter = std::ceil(from_ / (pi / 2)); quarter * (pi / 2) <= to_; ++quarter) include(direction_of(quarter * (pi / 2)));
  return {{{low[0], low[1], -infinity}}, {{high[0], high[1], infinity}}};
}

std::optional<double> Sector::measure() const { return (to_ - from_) / 2 * radius_ * radius_; }

}  // namespace crampon
