/// Normals between two materials at a node (contact/normal.hpp).

#include "unit/contact_geometry_cases.hpp"

namespace crampon::test {
namespace {

/// docs/theory/contact.md: a circle of eight cells in a matrix, both of particles in rows along the grid. Mean errors in degrees, over
/// the nodes with particles enough for a logistic regression.
TEST(ContactNormal, AroundCircle) {
  struct Expected {
    double l, gradient, linear, logistic;
  };
  for (const Expected& e : {Expected{0.25, 6.1, 6.1, 5.0}, Expected{0.125, 2.0, 3.9, 1.8}}) {
    double weights = 0, gradient = 0, linear = 0, logistic = 0;
    for (int trial = 0; trial < 16; ++trial) {
      const Vec<2> centre{{std::fmod(0.07 + 0.237 * trial, 1.), std::fmod(0.11 + 0.391 * trial, 1.)}};
      const auto particles = rows(e.l, 0, {}, {{12, 12}}, [&](const Vec<2>& x) {
        const double r = norm(x - centre);
        return std::fabs(r - 8) > 3 ? 0 : r < 8 ? -1 : 1;
      });
      for_nodes(particles, 10, GimpShape::boxes, e.l, [&](const Vec<2>& node, const View<2>& view) {
        const auto n = logistic_regression_normal<2>(view.points, unit_cell);
        if (!n) return;
        const Vec<2> radius = normalized(node - centre);
        weights += view.smaller();
        gradient += view.smaller() * degrees_between(view.gradient(), radius);
        linear += view.smaller() * degrees_between(*linear_regression_normal<2>(view.points, unit_cell), radius);
        logistic += view.smaller() * degrees_between(*n, radius);
      });
    }
    EXPECT_NEAR(gradient / weights, e.gradient, 0.3);
    EXPECT_NEAR(linear / weights, e.linear, 0.3);
    EXPECT_NEAR(logistic / weights, e.logistic, 0.2);
  }
}

TEST(ContactNormal, StraightInterface) {
  for (int angle = 0; angle <= 45; angle += 5) {
    double weights = 0, gradient = 0, logistic = 0;
    for (int trial = -5; trial <= 5; ++trial) {
      const Touching touching{angle * degree, 0.1 * trial};
      for_nodes(touching.particles(), 4, GimpShape::boxes, 0.25, [&](const Vec<2>&, const View<2>& view) {
        weights += view.smaller();
        gradient += view.smaller() * degrees_between(view.gradient(), touching.n());
        logistic += view.smaller() * degrees_between(logistic_normal(view.points, unit_cell), touching.n());
      });
    }
    EXPECT_LT(logistic / weights, 1) << angle;  // at most 0.83
    EXPECT_LT(gradient / weights, 2.3) << angle;
  }
}

/// Least value of f, downhill from zero by single arguments, however slowly.
template <std::size_t Count, class F>
double least(F f) {
  std::array<double, Count> at{};
  double best = f(at);
  for (double step = 1; step > 1e-6;) {
    bool better = false;
    for (double& c : at) {
      for (const double change : {-step, step}) {
        const double before = c;
        c += change;
        const double value = f(at);
        better = better || value < best;
        c = value < best ? c : before;
        best = std::fmin(best, value);
      }
    }
    if (!better) step /= 2;
  }
  return best;
}

/// The iteration stops when a step turns the normal by less than 0.26 degrees: near the least objective.
TYPED_TEST(ContactGeometry, LogisticRegressionFindsTheLeast) {
  constexpr int Dim = TypeParam::value;
  Random random(1);
  double excess = 0;
  constexpr int trials = 30;
  for (int trial = 0; trial < trials; ++trial) {
    const auto points = random.cloud<Dim>(40, random.direction<Dim>(), random.draw(-0.5, 0.5), trial % 2 ? 0.7 : 0.1);
    const auto objective = [&](const Vec<Dim>& beta, double constant) {
      double sum = 1e-2 * dot(beta, beta);
      for (const auto& p : points) sum += std::pow(static_cast<double>(p.side) - std::tanh((dot(beta, p.x) + constant) / 2), 2);
      return sum;
    };
    const auto found = logistic_regression_normal<Dim>(points, unit_cells<Dim>());
    ASSERT_TRUE(found);
    const double along_found = least<2>([&](const auto& at) { return objective(*found * at[0], at[1]); });
    const double anywhere = least<Dim + 1>([&](const auto& at) {
      Vec<Dim> beta;
      for (int k = 0; k < Dim; ++k) beta[k] = at[k];
      return objective(beta, at[Dim]);
    });
    EXPECT_GE(along_found, anywhere * (1 - 1e-6));
    EXPECT_LE(along_found, anywhere * 1.12);
    excess += (along_found / anywhere - 1) / trials;
  }
  EXPECT_LT(excess, 5e-3);
}

TYPED_TEST(ContactGeometry, NormalsKnowNoAxis) {
  constexpr int Dim = TypeParam::value;
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const auto points = random.cloud<Dim>(25, random.direction<Dim>(), random.draw(-0.3, 0.3), 0.3);
    for (const auto& regression : {logistic_regression_normal<Dim>, linear_regression_normal<Dim>}) {
      const auto normal_of = [&](const std::function<void(LabelledPoint<Dim>&)>& change) {
        auto changed = points;
        for (auto& p : changed) change(p);
        return regression(changed, unit_cells<Dim>()).value();
      };
      const Vec<Dim> n = normal_of([](auto&) {});
      EXPECT_NEAR(norm(n), 1, 1e-14);
      Vec<Dim> mirrored = n, turned = n;
      mirrored[0] = -n[0];
      turned[0] = -n[1], turned[1] = n[0];
      EXPECT_EQ(normal_of([](auto& p) { p.x[0] = -p.x[0]; }), mirrored);  // to the bit
      EXPECT_EQ(normal_of([](auto& p) { p.side = p.side == ContactSide::a ? ContactSide::b : ContactSide::a; }), -n);
      EXPECT_EQ(normal_of([](auto& p) { p.weight = 0x1p-20; }), n);
      EXPECT_LT(norm(normal_of([](auto& p) {
                       const double x = p.x[0];
                       p.x[0] = -p.x[1], p.x[1] = x;
                     }) -
                     turned),
                1e-10);
      const Vec<Dim> shift = random.vector<Dim>(1);
      EXPECT_LT(norm(normal_of([&](auto& p) { p.x += shift; }) - n), 1e-10);
    }
  }
}

/// Cells of unlike edges: points in units of the cell, normals in space.
TYPED_TEST(ContactGeometry, UnlikeEdges) {
  constexpr int Dim = TypeParam::value;
  Random random(3);
  Vec<Dim> cell;
  for (int k = 0; k < Dim; ++k) cell[k] = 0.01 * (1 << k);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec<Dim> n = random.direction<Dim>(), on_plane = random.vector<Dim>(0.003);
    std::vector<LabelledPoint<Dim>> points;
    for (int i = 0; i < 2000; ++i) {
      LabelledPoint<Dim> p;
      p.x = random.vector<Dim>(1.25);
      Vec<Dim> x = -on_plane;
      for (int k = 0; k < Dim; ++k) x[k] += p.x[k] * cell[k];
      p.side = dot(x, n) > 0 ? ContactSide::b : ContactSide::a;
      points.push_back(p);
    }
    EXPECT_LT(degrees_between(*logistic_regression_normal<Dim>(points, cell), n), 2);
    // The plane in units of the cell, from any point on it.
    const PlaneInCells plane = plane_in_cells(cell, n);
    Vec<Dim> m;
    for (int k = 0; k < Dim; ++k) m[k] = n[k] * cell[k] / plane.h;
    EXPECT_NEAR(norm(m), 1, 1e-14);
    double d = 0;
    for (int k = 0; k < Dim; ++k) d += m[k] * (on_plane[k] / cell[k]);
    EXPECT_NEAR(plane.h * d, dot(on_plane, n), 1e-16);
  }
}

TYPED_TEST(ContactGeometry, StrangeClouds) {
  constexpr int Dim = TypeParam::value;
  const Vec<Dim> cell = unit_cells<Dim>();
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec<Dim> n = random.direction<Dim>(), middle = random.vector<Dim>(1);
    const auto check = [&](const std::vector<LabelledPoint<Dim>>& points, double within) {
      for (const auto& regression : {logistic_regression_normal<Dim>, linear_regression_normal<Dim>}) {
        const auto found = regression(points, cell);
        ASSERT_TRUE(found);
        ASSERT_NEAR(norm(*found), 1, 1e-14);
        ASSERT_LT(degrees_between(*found, n), within);
      }
    };
    // Far apart, overlapping, all but equal, tiny, many against few, on one line.
    std::vector<LabelledPoint<Dim>> apart, overlapping = random.cloud<Dim>(400, n, 0, 1.5), tiny, few, line;
    for (int i = 0; i < 40; ++i) {
      const ContactSide side = i % 2 ? ContactSide::b : ContactSide::a;
      const double sign = static_cast<double>(side);
      apart.push_back({n * (3 * sign) + random.vector<Dim>(0.5), 1, side});
      tiny.push_back({middle + (n * sign + random.vector<Dim>(0.1)) * 1e-7, 1, side});
      few.push_back({middle + n * (i < 36 ? -1 : 1) + random.vector<Dim>(0.1), 1, i < 36 ? ContactSide::a : ContactSide::b});
      line.push_back({middle + n * (sign * (1 + i)), 1, side});
    }
    check(apart, 40);
    check(overlapping, 25);
    check(tiny, 4);
    check(few, 25);
    check(line, 1e-3);
    // Labels by chance: any direction, but a direction.
    for (auto& p : apart) p.side = random.draw(0, 1) < 0.5 ? ContactSide::a : ContactSide::b;
    check(apart, 181);
  }
  std::vector<LabelledPoint<Dim>> points = random.cloud<Dim>(30, cell, 5, 0);
  EXPECT_FALSE(linear_regression_normal<Dim>(points, cell));  // all of a
  EXPECT_FALSE(logistic_regression_normal<Dim>(points, cell));
  EXPECT_FALSE(linear_regression_normal<Dim>({}, cell));
  points.back() = {cell * 2., 1, ContactSide::b};
  EXPECT_TRUE(linear_regression_normal<Dim>(points, cell));
  EXPECT_FALSE(logistic_regression_normal<Dim>(points, cell));  // one of b is not enough
  for (std::size_t i = 0; i < 15; ++i) points[i + 15] = {points[i].x, 1, ContactSide::b};
  EXPECT_FALSE(linear_regression_normal<Dim>(points, cell));  // two bodies in one place
  EXPECT_FALSE(logistic_regression_normal<Dim>(points, cell));
}

TEST(ContactNormal, Gradients) {
  using G = VolumeGradient<2>;
  const G a{{{0, 2}}, 1}, b{{{1, 0}}, 3};
  const Vec<2> up{{0, 1}}, left{{-1, 0}};
  EXPECT_EQ(gradient_normal(GradientNormal::largest_gradient, a, b), up);
  EXPECT_EQ(gradient_normal(GradientNormal::largest_gradient, b, a), -up);
  EXPECT_EQ(gradient_normal(GradientNormal::largest_gradient, G{{{0, 1}}}, b), up);  // of equals a
  EXPECT_EQ(gradient_normal(GradientNormal::more_volume, a, b), left);
  EXPECT_EQ(gradient_normal(GradientNormal::average, a, b), normalized(Vec<2>{{-1, 2}}));
  EXPECT_EQ(gradient_normal(GradientNormal::largest_gradient, G{}, b), left);
  EXPECT_EQ(gradient_normal(GradientNormal::more_volume, a, G{{}, 9}), up);  // no gradient, no say
  for (const auto choice : {GradientNormal::largest_gradient, GradientNormal::more_volume, GradientNormal::average}) {
    EXPECT_EQ(gradient_normal(choice, G{}, G{}), Vec<2>{});
    EXPECT_EQ(gradient_normal(choice, G{{{0, 200}}, 9}, G{{{20, 0}}, 3, true}), left);
    EXPECT_EQ(gradient_normal(choice, G{{{20, 0}}, 3, true}, G{{{0, 200}}, 9}), -left);
    EXPECT_NE(gradient_normal(choice, G{{{0, 201}}, 9}, G{{{20, 0}}, 3, true}), left);
    EXPECT_EQ(gradient_normal(choice, G{{{0, 20}}, 9}, G{{}, 3, true}), up);
  }
}

}  // namespace
}  // namespace crampon::test
