#include <gtest/gtest.h>
// After gtest.h.
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "crampon/geometry/angle.hpp"
#include "geometry_cases.hpp"

namespace crampon {
namespace {

using namespace testing;

TEST(Shapes, AreasAgreeWithCounting) {
  // A count on a lattice of spacing s misses a smooth boundary of length L by a walk of about sqrt(L s) s; straight edges may be off by
  // L s/2 at worst: with s = 1/1200, L < 5 and areas above 0.3 that is 0.7 %, and far less unless an edge lies along the lattice.
  const FillGrid grid = grid_around_origin(2, 600);
  for (const auto& [name, shape] : plane_shapes()) {
    ASSERT_TRUE(shape->measure()) << name;
    const double counted = total(fill_shape(*shape, grid, {2, 2, 1}));
    EXPECT_NEAR(counted, *shape->measure(), 2e-3 * *shape->measure()) << name;
  }
}

TEST(Shapes, VolumesAgreeWithCounting) {
  // Spacing 1/120: an aligned face of a box of height .7 may be off by half a spacing, 0.6 %.
  const FillGrid grid = grid_around_origin(3, 60);
  for (const auto& [name, shape] : solid_shapes()) {
    ASSERT_TRUE(shape->measure()) << name;
    EXPECT_NEAR(total(fill_shape(*shape, grid, {2, 2, 2})), *shape->measure(), 7e-3 * *shape->measure()) << name;
  }
}

TEST(Shapes, ClosedForms) {
  EXPECT_DOUBLE_EQ(*Disk(Vec<2>{}, 2).measure(), 4 * pi);
  EXPECT_DOUBLE_EQ(*Ring(Vec<2>{}, 1, 2).measure(), 3 * pi);
  EXPECT_DOUBLE_EQ(*Ellipse(Vec<2>{}, {{3, 2}}, 1).measure(), 6 * pi);
  EXPECT_DOUBLE_EQ(*Sector(Vec<2>{}, 2, 0, pi / 2).measure(), pi);
  EXPECT_DOUBLE_EQ(*Sphere({}, 3).measure(), 36 * pi);
  EXPECT_DOUBLE_EQ(*Cylinder({}, {{0, 3, 4}}, 2).measure(), 20 * pi);
  EXPECT_DOUBLE_EQ(*Polygon(loop({{0, 0}, {4, 0}, {0, 3}}), {loop({{1, 1}, {1, .5}, {.5, .5}})}).measure(), 6 - .125);
  const RegionPtr disk = make<Disk>(Vec<2>{}, 1.);
  EXPECT_FALSE(Union({disk, disk}).measure());
  EXPECT_FALSE(Intersection({disk, disk}).measure());
  EXPECT_FALSE(Difference(disk, {disk}).measure());
  EXPECT_FALSE(Rotated(disk, 1, {}, {{1, 0, 0}}).measure()) << "an area out of its plane";
}

TEST(Shapes, DistanceIsThatOfTheNearestBoundaryPoint) {
  // The ellipse against many points of its parametric form, the sector against distances read off by hand.
  const Vec<2> semi{{.55, .21}};
  const double angle = .6;
  const Ellipse ellipse({{.01, .02}}, semi, angle);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-.8, .8);
  for (int k = 0; k < 200; ++k) {
    const Vec<3> x{{coordinate(random), coordinate(random), 0}};
    double nearest = infinity;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double t = 2 * pi * i / n, u = semi[0] * std::cos(t), v = semi[1] * std::sin(t);
      nearest = std::min(nearest, std::hypot(.01 + u * std::cos(angle) - v * std::sin(angle) - x[0],
                                             .02 + u * std::sin(angle) + v * std::cos(angle) - x[1]));
    }
    // The nearest of points 2 pi .55/n apart is too far by at most their distance squared over twice the distance, or half the gap.
    EXPECT_NEAR(std::abs(ellipse.distance(x)), nearest, 2e-4);
    EXPECT_LE(std::abs(ellipse.distance(x)), nearest + 1e-12);
  }
  // At the centre and beside it by less than round-off, where the foot is far from unique.
  for (const double tiny : {0., 1e-17, 1e-300}) {
    EXPECT_DOUBLE_EQ(Ellipse({{0, 0}}, {{.5, .2}}).distance({{tiny, tiny, 0}}), -.2);
    EXPECT_DOUBLE_EQ(Ellipse({{0, 0}}, {{.2, .5}}).distance({{tiny, -tiny, 0}}), -.2);
    EXPECT_DOUBLE_EQ(Ellipse({{0, 0}}, {{.5, .5}}).distance({{tiny, tiny, 0}}), -.5);
  }
  const Sector sector({{0, 0}}, 1, 0, pi / 2);
  EXPECT_DOUBLE_EQ(sector.distance({{.1, .3, 0}}), -.1);
  EXPECT_DOUBLE_EQ(sector.distance({{-.3, .4, 0}}), .3);
  EXPECT_DOUBLE_EQ(sector.distance({{-.3, -.4, 0}}), .5);
  EXPECT_DOUBLE_EQ(sector.distance({{1.3, -.4, 0}}), .5);
  EXPECT_DOUBLE_EQ(sector.distance({{.6 * 1.5, .8 * 1.5, 0}}), .5);
}

TEST(Shapes, DistancesNeverChangeFasterThanTheirPoint) {
  // fill_shape skips whole balls because of this.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] { return Vec<3>{{coordinate(random), coordinate(random), coordinate(random)}}; };
  for (const auto& [name, shape] : all_shapes()) {
    for (int k = 0; k < 5000; ++k) {
      const Vec<3> x = point();
      const Vec<3> y = k % 2 ? point() : x + 1e-3 * point();
      // 1e-12: rounding of distances near one, and of the ellipse's root.
      ASSERT_LE(std::abs(shape->distance(x) - shape->distance(y)), norm(x - y) + 1e-12) << name;
    }
  }
}

TEST(Shapes, BoundsHoldTheShapeAndNoMore) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const std::vector<Named>& group : {plane_shapes(), solid_shapes()}) {
    for (const auto& [name, shape] : group) {
      const Bounds3 box = shape->bounds();
      Vec<3> low{{1, 1, 1}}, high{{-1, -1, -1}};
      for (int n = 0; n < 400000; ++n) {
        const Vec<3> x{{coordinate(random), coordinate(random), coordinate(random)}};
        if (!shape->contains(x)) continue;
        for (int k = 0; k < shape->dimension(); ++k) {
          ASSERT_GE(x[k], box.low[k] - 1e-15) << name;
          ASSERT_LE(x[k], box.high[k] + 1e-15) << name;
          low[k] = std::min(low[k], x[k]);
          high[k] = std::max(high[k], x[k]);
        }
      }
      // Tight where the shape itself is: a placed shape's box is the box of a turned box and may be wider.
      if (name.find("turned") != std::string::npos) continue;
      for (int k = 0; k < shape->dimension(); ++k) {
        // Samples within 0.1 of a corner of a sector or a pole of a sphere: enough of 400 000 that one comes this near.
        EXPECT_NEAR(low[k], box.low[k], .05) << name;
        EXPECT_NEAR(high[k], box.high[k], .05) << name;
      }
    }
  }
}

TEST(Shapes, BoundariesBelongToThem) {
  const Rectangle rectangle({{0.1, 0.2}}, {{0.3, 0.7}});
  for (const double x : {0.1, 0.3})
    for (const double y : {0.2, 0.7}) EXPECT_TRUE(rectangle.contains({{x, y, 99}}));
  EXPECT_FALSE(rectangle.contains({{std::nextafter(0.3, 1), 0.5, 0}}));
  EXPECT_TRUE(rectangle.contains({{0.3 + 1e-9, 0.5, 0}}, 2e-9));
  EXPECT_FALSE(rectangle.contains({{0.3 + 3e-9, 0.5, 0}}, 2e-9));
  const Disk disk({{1, 1}}, 5);
  EXPECT_TRUE(disk.contains({{4, 5, 0}}));
  EXPECT_FALSE(disk.contains({{4, 5 + 1e-14, 0}}));
  const Ring ring({{0, 0}}, 5, 13);
  EXPECT_TRUE(ring.contains({{3, 4, 0}}));
  EXPECT_TRUE(ring.contains({{-5, 12, 0}}));
  EXPECT_FALSE(ring.contains({{3, 3.999, 0}}));
  const Ellipse ellipse({{0, 0}}, {{2, 1}}, pi / 2);
  EXPECT_TRUE(ellipse.contains({{0, 2, 0}}));
  EXPECT_TRUE(ellipse.contains({{-1, 0, 0}}));
  EXPECT_TRUE(ellipse.contains({{1 + 1e-6, 0, 0}}, 1.1e-6));
  EXPECT_FALSE(ellipse.contains({{1 + 1e-6, 0, 0}}, 0.9e-6));
  EXPECT_TRUE(Sector({{0, 0}}, 1, 0, pi / 2).contains({{0, 1, 0}}));
  EXPECT_TRUE(Sector({{0, 0}}, 1, 0, pi / 2).contains({{0, 0, 0}}));
  EXPECT_TRUE(Sector({{0, 0}}, 1, 0, 2 * pi).contains({{.5, 0, 0}})) << "a full turn has no seam";
  EXPECT_LT(Sector({{0, 0}}, 1, 0, 2 * pi).distance({{.5, 0, 0}}), -.4);
  EXPECT_TRUE(Box({{0, 0, 0}}, {{1, 1, 1}}).contains({{1, 0, 1}}));
  EXPECT_TRUE(Sphere({{0, 0, 0}}, 3).contains({{1, 2, 2}}));
  EXPECT_TRUE(Cylinder({{0, 0, 0}}, {{0, 0, 2}}, 5).contains({{3, 4, 2}}));
  EXPECT_FALSE(Cylinder({{0, 0, 0}}, {{0, 0, 2}}, 5).contains({{3, 4, 2.001}}));
  const HalfPlane below({{0, 1, 0}}, {{0, 2, 0}}, 2);
  EXPECT_TRUE(below.contains({{-1e9, 1, 5}}));
  EXPECT_FALSE(below.contains({{0, std::nextafter(1., 2.), 0}}));
  EXPECT_EQ(below.bounds().high[1], 1);
  EXPECT_EQ(below.bounds().low[1], -infinity);
  const Point point({{1, 2, 7}}, 2);
  EXPECT_TRUE(point.contains({{1, 2, 0}}));
  EXPECT_FALSE(point.contains({{1, 2 + 1e-9, 0}}, 1e-10));
  const Line line({{0, 0, 0}}, {{1, 1, 0}}, 2);
  EXPECT_TRUE(line.contains({{.25, .25, 0}}));
  EXPECT_TRUE(line.contains({{1, 1, 0}}));
  EXPECT_FALSE(line.contains({{1.001, 1.001, 0}}, 1e-3));
  EXPECT_TRUE(Everywhere().contains({{1e300, 0, 0}}));
}

TEST(Shapes, DifferenceKeepsItsNewBoundary) {
  const Difference plate(make<Rectangle>(Vec<2>{{0, 0}}, Vec<2>{{20, 20}}), {make<Disk>(Vec<2>{{10, 10}}, 5.)});
  EXPECT_TRUE(plate.contains({{13, 14, 0}}));
  EXPECT_FALSE(plate.contains({{13, 13.999, 0}}));
  EXPECT_TRUE(plate.contains({{13, 13.999, 0}}, 1e-3));
  EXPECT_TRUE(plate.contains({{0, 0, 0}}));
}

RC_GTEST_PROP(PolygonProperty, AgreesWithTheWindingNumberAndContainsItsEdges, ()) {
  // A star around the origin with random radii: simple by construction. Integer corners: points on edges are exact.
  const int n = *rc::gen::inRange(3, 12);
  Corners corners;
  for (int k = 0; k < n; ++k) {
    const double radius = *rc::gen::inRange(20, 1000);
    corners.push_back({{std::round(radius * std::cos(2 * pi * k / n)), std::round(radius * std::sin(2 * pi * k / n))}});
  }
  if (!find_polygon_faults(corners, {}).empty()) return;
  const Polygon polygon(corners);
  for (int k = 0; k < n; ++k) {
    const Vec<2>&a = corners[k], &b = corners[(k + 1) % n];
    RC_ASSERT(polygon.contains({{a[0], a[1], 0}}));
    // Halves of integers: the midpoint is on the edge exactly.
    RC_ASSERT(polygon.contains({{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0}}));
    RC_ASSERT(polygon.distance({{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0}}) == 0);
  }
  for (int i = 0; i < 20; ++i) {
    const Vec<2> x{{*rc::gen::inRange(-1000, 1000) + .25, *rc::gen::inRange(-1000, 1000) + .125}};
    double turned = 0;
    for (int k = 0; k < n; ++k) {
      const Vec<2> a = corners[k] - x, b = corners[(k + 1) % n] - x;
      turned += std::atan2(cross(a, b), dot(a, b));
    }
    const double d = polygon.distance({{x[0], x[1], 0}});
    if (std::abs(d) > 1e-6) RC_ASSERT((d < 0) == (std::abs(turned) > pi));
  }
}

TEST(PolygonTest, HolesAreOpenAndCornersOnTheRayCountOnce) {
  const Polygon frame(loop({{0, 0}, {6, 0}, {6, 6}, {0, 6}}), {loop({{2, 3}, {3, 2}, {4, 3}, {3, 4}})});
  EXPECT_TRUE(frame.contains({{1, 3, 0}})) << "the ray passes two corners of the hole";
  EXPECT_FALSE(frame.contains({{3, 3, 0}}));
  EXPECT_TRUE(frame.contains({{2.5, 2.5, 0}})) << "edge of the hole";
  EXPECT_TRUE(frame.contains({{4, 3, 0}})) << "corner of the hole";
  EXPECT_FALSE(frame.contains({{-1, 0, 0}}));
  EXPECT_FALSE(frame.contains({{-1, 6, 0}}));
  EXPECT_DOUBLE_EQ(*frame.measure(), 34);
  // 0.1 + 0.2 is not 0.3: exactness is about the doubles given.
  const Polygon thin(loop({{0, 0}, {3, 1}, {3, 1 + 1e-15}}));
  EXPECT_TRUE(thin.contains({{1.5, .5, 0}}));
  EXPECT_FALSE(thin.contains({{1.5, std::nextafter(.5, 0.), 0}}));
  EXPECT_TRUE(Polygon(loop({{0, 0}, {1, 0}, {0, 1}, {0, 0}})).contains({{.5, .5, 0}})) << "closed by repeating the first corner";
}

TEST(PolygonTest, Faults) {
  const Corners square = loop({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  const auto fault = [](const Corners& outer, const std::vector<Corners>& holes = {}) {
    const auto faults = find_polygon_faults(outer, holes);
    return faults.empty() ? "" : std::to_string(faults[0].loop) + " " + faults[0].what;
  };
  const auto small = [](double x, double y, double size) { return loop({{x, y}, {x + size, y}, {x, y + size}}); };
  EXPECT_EQ(fault(square, {small(1, 1, 1), small(2.5, 1, 1)}), "");
  EXPECT_EQ(fault(loop({{0, 0}, {1, 0}})), "-1 has 2 corners, an area needs at least 3");
  EXPECT_EQ(fault(loop({{0, 0}, {4, 4}, {4, 0}, {0, 4}})), "-1 crosses itself: the edge from corner 1 meets the edge from corner 3");
  EXPECT_EQ(fault(loop({{0, 0}, {1, 0}, {1, 0}, {0, 1}})), "-1 repeats corner 2");
  EXPECT_EQ(fault(loop({{0, 0}, {2, 0}, {1, 0}, {0, 1}})), "-1 folds back on itself at corner 2");
  EXPECT_EQ(fault(loop({{0, 0}, {2, 0}, {1, 0}})), "-1 folds back on itself at corner 2");
  EXPECT_EQ(fault(square, {small(3, 1, 2)}), "0 touches or crosses the outer boundary");
  EXPECT_EQ(fault(square, {small(5, 5, 1)}), "0 lies outside the polygon");
  EXPECT_EQ(fault(square, {small(1, 1, 2), small(1.2, 1.2, .5)}), "1 and hole 1 lie inside one another");
  EXPECT_EQ(fault(square, {small(1, 1, 1), small(1.5, 1, 1)}), "1 touches or crosses hole 1");
}

RC_GTEST_PROP(PlacedProperty, MovingPointAndShapeTogetherChangesNothing, ()) {
  const auto number = [](int range) { return *rc::gen::inRange(-range, range + 1) * 0.01; };
  static const std::vector<Named> group = solid_shapes();
  const RegionPtr shape = group[*rc::gen::inRange<std::size_t>(0, group.size())].shape;
  const Vec<3> x{{number(80), number(80), number(80)}}, about{{number(50), number(50), number(50)}}, by{{number(200), number(200), 1}};
  const Vec<3> axis{{number(100), number(100), 1}};
  const double angle = number(700);
  // The turned point by Rodrigues' formula, written out.
  const Vec<3> r = x - about, a = normalized(axis);
  const Vec<3> a_cross_r{{a[1] * r[2] - a[2] * r[1], a[2] * r[0] - a[0] * r[2], a[0] * r[1] - a[1] * r[0]}};
  const Vec<3> turned = about + r * std::cos(angle) + a_cross_r * std::sin(angle) + a * (dot(a, r) * (1 - std::cos(angle)));
  // 1e-13: a few roundings of numbers of order one.
  RC_ASSERT(std::abs(Rotated(shape, angle, about, axis).distance(turned) - shape->distance(x)) < 1e-13);
  RC_ASSERT(std::abs(Translated(shape, by).distance(x + by) - shape->distance(x)) < 1e-13);
}

TEST(Placed, QuarterTurnsAreExact) {
  const Rotated turned(make<Rectangle>(Vec<2>{{0, 0}}, Vec<2>{{2, 1}}), pi / 2, {});
  EXPECT_EQ(turned.bounds().low, (Vec<3>{{-1, 0, -infinity}}));
  EXPECT_EQ(turned.bounds().high, (Vec<3>{{0, 2, infinity}}));
  EXPECT_TRUE(turned.contains({{-1, 2, 0}}));
  for (int k = -9; k <= 9; ++k) {
    const Vec<2> d = direction_of(k * pi / 2);
    EXPECT_TRUE((d[0] == 0 && std::abs(d[1]) == 1) || (d[1] == 0 && std::abs(d[0]) == 1)) << k;
    EXPECT_NEAR(d[0], std::cos(k * pi / 2), 1e-14);
    EXPECT_NEAR(d[1], std::sin(k * pi / 2), 1e-14);
  }
  EXPECT_EQ(Rotated(make<Disk>(Vec<2>{}, 1.), 1, {}, {{1, 0, 0}}).dimension(), 3);
}

}  // namespace
}  // namespace crampon
