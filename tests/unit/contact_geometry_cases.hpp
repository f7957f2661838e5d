#pragma once
/// Particles on both sides of an interface and what a node sees of them, for the tests of contact/normal.hpp, edge_map.hpp and
/// separation.hpp: shape functions and sums written here once more. Lengths in cells unless a cell is given.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <type_traits>
#include <vector>

#include "crampon/contact/separation.hpp"
#include "crampon/shape/registry.hpp"
#include "unit/box_profile.hpp"

namespace crampon::test {

using std::numbers::pi;

template <int Dim>
struct Particle {
  Vec<Dim> x;
  std::array<Vec<Dim>, Dim> half_edges{};
  ContactSide side = ContactSide::a;
};

/// A shape function, by its boxes.
using Shape = ProfileBoxes;
/// All of the family.
inline std::vector<Shape> all_shapes() {
  std::vector<Shape> boxes;
  for_each_shape([&]<class Of>(std::type_identity<Of>) { boxes.push_back(Of::boxes); });
  return boxes;
}
inline const std::vector<Shape> shapes = all_shapes();

/// What a node knows of both sides; 0 is a, 1 is b.
template <int Dim>
struct View {
  double V[2] = {0, 0};
  Vec<Dim> x[2], g[2];  ///< mean positions from the node
  std::vector<LabelledPoint<Dim>> points;
  std::vector<Particle<Dim>> particles;
  bool both() const { return V[0] > 0 && V[1] > 0; }
  double smaller() const { return std::fmin(V[0], V[1]); }
  double share() const { return smaller() / (V[0] + V[1]); }
  Vec<Dim> gradient() const {
    return gradient_normal(GradientNormal::largest_gradient, VolumeGradient<Dim>{g[0], V[0]}, VolumeGradient<Dim>{g[1], V[1]});
  }
};

template <int Dim>
View<Dim> see(const std::vector<Particle<Dim>>& particles, const Vec<Dim>& node, const Vec<Dim>& cell, Shape shape, double l) {
  View<Dim> view;
  constexpr double furthest = 3;  // cells: no shape function reaches so far
  for (Particle<Dim> p : particles) {
    p.x -= node;
    bool is_far = false;
    for (int k = 0; k < Dim; ++k) is_far = is_far || std::fabs(p.x[k]) > furthest * cell[k];
    if (is_far) continue;
    LabelledPoint<Dim> point;
    double S = 1, V = 1;
    Vec<Dim> G;
    for (int k = 0; k < Dim; ++k) {
      point.x[k] = p.x[k] / cell[k];
      S *= profile(shape, point.x[k], l).value;
      V *= 2 * l * cell[k];
    }
    if (S < 1e-14) continue;
    for (int k = 0; k < Dim; ++k) G[k] = S / profile(shape, point.x[k], l).value * profile(shape, point.x[k], l).slope / cell[k];
    const int side = p.side == ContactSide::b;
    view.V[side] += V * S;
    view.x[side] += V * S * p.x;
    view.g[side] += V * G;
    point.side = p.side;
    view.points.push_back(point);
    view.particles.push_back(p);
  }
  for (int side = 0; side < 2; ++side) view.x[side] *= 1 / view.V[side];
  return view;
}

/// Square particles of half size l in rows turned by `angle` about `origin`; those for which `side` tells one. 2D, cells of size 1.
using Sides = std::function<int(const Vec<2>&)>;
inline std::vector<Particle<2>> rows(double l, double angle, const Vec<2>& origin, const Vec<2>& half_extent, const Sides& side) {
  std::vector<Particle<2>> out;
  const Vec<2> u{{std::cos(angle), std::sin(angle)}}, v{{-u[1], u[0]}};
  const int ni = static_cast<int>(std::lround(half_extent[0] / (2 * l))), nj = static_cast<int>(std::lround(half_extent[1] / (2 * l)));
  for (int i = -ni; i < ni; ++i) {
    for (int j = -nj; j < nj; ++j) {
      const Vec<2> x = origin + u * ((2 * i + 1) * l) + v * ((2 * j + 1) * l);
      if (side(x) != 0) out.push_back({x, {u * l, v * l}, side(x) < 0 ? ContactSide::a : ContactSide::b});
    }
  }
  return out;
}

/// Half planes that touch along a line at `angle`: a below, b above, `offset` above the origin. Their particles lie in rows along the
/// line or along the grid.
enum class Rows { along_line, along_grid };
struct Touching {
  double angle = 0, offset = 0, l = 0.25;
  Rows rows_are = Rows::along_line;
  Vec<2> n() const { return {{-std::sin(angle), std::cos(angle)}}; }
  Vec<2> t() const { return {{std::cos(angle), std::sin(angle)}}; }
  std::vector<Particle<2>> particles(double half_length = 7) const {
    const Vec<2> on_line = n() * offset;
    const Sides sides = [&](const Vec<2>& x) { return dot(x - on_line, n()) < 0 ? -1 : 1; };
    if (rows_are == Rows::along_grid) return rows(l, 0, {}, {{half_length, half_length}}, sides);
    return rows(l, angle, on_line + t() * (1.73 * offset), {{half_length, 4}}, sides);
  }
};
inline constexpr double degree = pi / 180;
inline const Vec<2> unit_cell{{1, 1}};

/// f(node, view) for grid nodes that see both sides, within `reach` of the origin.
template <class F>
void for_nodes(const std::vector<Particle<2>>& particles, int reach, Shape shape, double l, F f) {
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const Vec<2> node{{static_cast<double>(i), static_cast<double>(j)}};
      const View<2> view = see(particles, node, unit_cell, shape, l);
      if (view.both()) f(node, view);
    }
  }
}

inline EdgeMap edge_map(Shape shape, double l, Packing packing = Packing::layers) {
  const double half_sizes[] = {l};
  return EdgeMap(shape, half_sizes, packing);
}

template <int Dim>
double degrees_between(const Vec<Dim>& a, const Vec<Dim>& b) {
  return 2 * std::asin(std::fmin(1., norm(a - b) / 2)) / degree;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
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
  /// Points within a cell or so of the node; b where n.x > offset, but for noise.
  template <int Dim>
  std::vector<LabelledPoint<Dim>> cloud(int count, const Vec<Dim>& n, double offset, double noise) {
    std::vector<LabelledPoint<Dim>> points;
    for (int i = 0; i < count; ++i) {
      const Vec<Dim> x = vector<Dim>(1.25);
      points.push_back({x, 1, dot(x, n) + draw(-noise, noise) > offset ? ContactSide::b : ContactSide::a});
    }
    return points;
  }

 private:
  std::mt19937_64 engine_;
};

template <class D>
class ContactGeometry : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ContactGeometry, Dimensions);

template <int Dim>
Vec<Dim> unit_cells() {
  Vec<Dim> cell;
  for (int k = 0; k < Dim; ++k) cell[k] = 1;
  return cell;
}

/// With the fallback that callers have.
template <int Dim>
Vec<Dim> logistic_normal(const std::vector<LabelledPoint<Dim>>& points, const Vec<Dim>& cell) {
  const auto n = logistic_regression_normal<Dim>(points, cell);
  return n ? *n : linear_regression_normal<Dim>(points, cell).value_or(Vec<Dim>{});
}

}  // namespace crampon::test
