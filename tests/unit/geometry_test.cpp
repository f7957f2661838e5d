#include <gtest/gtest.h>
// After gtest.h.
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "crampon/geometry/angle.hpp"
#include "crampon/geometry/arc.hpp"
#include "crampon/geometry/boxes.hpp"
#include "crampon/geometry/combine.hpp"
#include "crampon/geometry/fill.hpp"
#include "crampon/geometry/flats.hpp"
#include "crampon/geometry/particles_csv.hpp"
#include "crampon/geometry/placed.hpp"
#include "crampon/geometry/plane_cut.hpp"
#include "crampon/geometry/polygon.hpp"
#include "crampon/geometry/round.hpp"
#include "crampon/geometry/shapes.hpp"
#include "crampon/geometry/solids.hpp"

namespace crampon {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T, class... Args>
ShapePtr make(Args&&... args) {
  return std::make_shared<T>(std::forward<Args>(args)...);
}

struct Named {
  std::string name;
  ShapePtr shape;
};

Corners loop(std::initializer_list<std::pair<double, double>> corners) {
  Corners out;
  for (const auto& [x, y] : corners) out.push_back({{x, y}});
  return out;
}

// About one across, around the origin, none aligned with the lattices below; every kind of bounded shape, and placed ones.
const Corners notched = loop({{-.55, -.5}, {.5, -.45}, {.6, .5}, {.05, -.05}, {-.45, .55}});
const Corners notched_hole = loop({{-.3, -.3}, {-.05, -.32}, {-.25, -.1}});

std::vector<Named> plane_shapes() {
  const ShapePtr polygon = make<Polygon>(notched, std::vector<Corners>{notched_hole});
  return {{"rectangle", make<Rectangle>(Vec<2>{{-.52, -.31}}, Vec<2>{{.47, .44}})},
          {"disk", make<Disk>(Vec<2>{{.013, -.021}}, .513)},
          {"ellipse", make<Ellipse>(Vec<2>{{.01, .02}}, Vec<2>{{.55, .21}}, .6)},
          {"tall ellipse", make<Ellipse>(Vec<2>{{.01, .02}}, Vec<2>{{.2, .57}})},
          {"ring", make<Ring>(Vec<2>{{.017, -.01}}, .27, .55)},
          {"sector", make<Sector>(Vec<2>{{-.1, -.2}}, .7, .3, 1.9)},
          {"wide sector", make<Sector>(Vec<2>{{.02, .03}}, .52, -.7, 4.1)},
          {"polygon", polygon},
          {"turned polygon", make<Rotated>(polygon, .4, Vec<3>{{.1, .05, 0}})},
          {"shifted, turned rectangle",
           make<Translated>(make<Rotated>(make<Rectangle>(Vec<2>{{-.4, -.2}}, Vec<2>{{.5, .3}}), 1., Vec<3>{}), Vec<3>{{.04, -.03, 0}})}};
}

std::vector<Named> solid_shapes() {
  const ShapePtr box = make<Box>(Vec<3>{{-.5, -.3, -.41}}, Vec<3>{{.45, .4, .33}});
  return {{"box", box},
          {"sphere", make<Sphere>(Vec<3>{{.01, -.02, .03}}, .52)},
          {"cylinder", make<Cylinder>(Vec<3>{{-.3, -.2, -.25}}, Vec<3>{{.35, .25, .2}}, .3)},
          {"turned box", make<Rotated>(box, .7, Vec<3>{{.05, 0, 0}}, Vec<3>{{1, 2, -1}})}};
}

std::vector<Named> all_shapes() {
  std::vector<Named> all = plane_shapes();
  for (Named& s : solid_shapes()) all.push_back(s);
  all.push_back({"union", make<Union>(std::vector<ShapePtr>{all[0].shape, all[1].shape})});
  all.push_back({"intersection", make<Intersection>(std::vector<ShapePtr>{all[1].shape, all[2].shape})});
  all.push_back({"difference", make<Difference>(all[0].shape, std::vector<ShapePtr>{all[2].shape})});
  all.push_back({"half-plane", make<HalfPlane>(Vec<3>{{.1, .2, 0}}, Vec<3>{{3, -4, 0}}, 2)});
  all.push_back({"half-space", make<HalfPlane>(Vec<3>{{.1, .2, .3}}, Vec<3>{{1, -2, 2}}, 3)});
  all.push_back({"point", make<Point>(Vec<3>{{.1, .2, .3}}, 3)});
  all.push_back({"line", make<Line>(Vec<3>{{-.1, .2, 0}}, Vec<3>{{.4, -.2, 0}}, 2)});
  return all;
}

// Cells of size `cell` over [-1, 1] in each axis.
FillGrid grid_around_origin(int dimension, int cells_per_unit) {
  const double h = 1. / cells_per_unit;
  const int n = 2 * cells_per_unit;
  return {dimension, {{-1, -1, dimension == 3 ? -1. : 0.}}, {{h, h, h}}, {{n, n, dimension == 3 ? n : 1}}};
}

double total(const std::vector<FilledParticle>& particles) {
  double sum = 0;
  for (const FilledParticle& p : particles) sum += p.measure;
  return sum;
}

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
  const ShapePtr disk = make<Disk>(Vec<2>{}, 1.);
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
  const ShapePtr shape = group[*rc::gen::inRange<std::size_t>(0, group.size())].shape;
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

TEST(Fill, RectangleOnGridLinesHasEveryParticleAtItsPlace) {
  const FillGrid grid{2, {{-1, 2, 0}}, {{.5, .25, 0}}, {{8, 6, 1}}};
  const auto particles = fill_shape(Rectangle({{0, 2.25}}, {{1, 3}}), grid, {2, 3, 1});
  ASSERT_EQ(particles.size(), 2u * 3 * 6);
  // Cells row by row, x fastest, and so within each cell.
  std::size_t next = 0;
  for (int cy = 1; cy < 4; ++cy)
    for (int cx = 2; cx < 4; ++cx)
      for (int sy = 0; sy < 3; ++sy)
        for (int sx = 0; sx < 2; ++sx, ++next) {
          EXPECT_NEAR(particles[next].position[0], -1 + .5 * (cx + (sx + .5) / 2), 1e-15);
          EXPECT_NEAR(particles[next].position[1], 2 + .25 * (cy + (sy + .5) / 3), 1e-15);
          EXPECT_EQ(particles[next].position[2], 0);
          EXPECT_DOUBLE_EQ(particles[next].measure, .5 * .25 / 6);
        }
}

TEST(Fill, BruteForceFindsTheSameParticles) {
  for (const auto& [name, shape] : all_shapes()) {
    for (const int dimension : {2, 3}) {
      const FillGrid grid = grid_around_origin(dimension, 9);
      std::vector<Vec<3>> expected;
      const int n = 18 * 2;
      for (int k = 0; k < (dimension == 3 ? n : 1); ++k)
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) {
            Vec<3> x{{-1 + (i + .5) / 18, -1 + (j + .5) / 18, dimension == 3 ? -1 + (k + .5) / 18 : 0}};
            if (shape->contains(x, 1e-9 / 18)) expected.push_back(x);
          }
      auto found = fill_shape(*shape, grid, {2, 2, 2});
      ASSERT_EQ(found.size(), expected.size()) << name << " in " << dimension << "D";
      const auto before = [](const Vec<3>& a, const Vec<3>& b) {
        return std::lexicographical_compare(a.c.begin(), a.c.end(), b.c.begin(), b.c.end(),
                                            [](double u, double v) { return u < v - 1e-9; });
      };
      std::sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return before(a.position, b.position); });
      std::sort(expected.begin(), expected.end(), before);
      for (std::size_t k = 0; k < found.size(); ++k) ASSERT_LT(norm(found[k].position - expected[k]), 1e-13) << name;
    }
  }
}

// Measures by place on the lattice of spacing s from `origin`; places are doubled indices, so that mirroring about 0 is a change of sign.
std::map<std::array<long, 3>, double> by_place(const std::vector<FilledParticle>& particles, const Vec<3>& centre, double s) {
  std::map<std::array<long, 3>, double> places;
  for (const FilledParticle& p : particles) {
    std::array<long, 3> place{};
    for (int k = 0; k < 3; ++k) place[k] = std::lround(2 * (p.position[k] - centre[k]) / s);
    places[place] = p.measure;
  }
  return places;
}

TEST(Fill, SymmetricShapesFillSymmetrically) {
  // Cells of 0.1 and a centre of 0.7 are not exact in binary: symmetry must survive round-off. Radii through particle centres included.
  const double h = .1, s = h / 2;
  const FillGrid plane{2, {{0, 0, 0}}, {{h, h, h}}, {{14, 14, 1}}};
  const FillGrid space{3, {{0, 0, 0}}, {{h, h, h}}, {{14, 14, 14}}};
  for (const FillMeasure measure : {FillMeasure::lattice, FillMeasure::matched}) {
    for (const double radius : {.5, .43, s * std::hypot(2.5, 6.5), s * 2.5}) {
      const std::vector<std::pair<ShapePtr, const FillGrid*>> cases{
          {make<Disk>(Vec<2>{{.7, .7}}, radius), &plane},
          {make<Ellipse>(Vec<2>{{.7, .7}}, Vec<2>{{radius, .6 * radius}}), &plane},
          {make<Ring>(Vec<2>{{.7, .7}}, .4 * radius, radius), &plane},
          {make<Difference>(make<Rectangle>(Vec<2>{{.7 - radius, .7 - radius}}, Vec<2>{{.7 + radius, .7 + radius}}),
                            std::vector<ShapePtr>{make<Disk>(Vec<2>{{.7, .7}}, radius / 2)}),
           &plane},
          {make<Sphere>(Vec<3>{{.7, .7, .7}}, radius), &space}};
      for (const auto& [shape, grid] : cases) {
        const auto particles = fill_shape(*shape, *grid, {2, 2, 2}, measure);
        ASSERT_FALSE(particles.empty());
        const auto places = by_place(particles, {{.7, .7, grid->dimension == 3 ? .7 : 0}}, s);
        ASSERT_EQ(places.size(), particles.size());
        for (int axis = 0; axis < grid->dimension; ++axis)
          for (const auto& [place, value] : places) {
            auto mirrored = place;
            mirrored[axis] = -mirrored[axis];
            const auto found = places.find(mirrored);
            ASSERT_NE(found, places.end());
            ASSERT_EQ(found->second, value) << "to the last bit";
          }
      }
    }
  }
}

TEST(Fill, MatchedMeasureIsTheShapesAndStaysSmooth) {
  // Ten cells of 2 x 2 (2 x 2 x 2) particles across, and more.
  const auto check = [](const Shape& shape, int dimension, int cells_per_unit) {
    const FillGrid grid = grid_around_origin(dimension, cells_per_unit);
    const auto lattice = fill_shape(shape, grid, {2, 2, 2});
    const auto matched = fill_shape(shape, grid, {2, 2, 2}, FillMeasure::matched);
    ASSERT_EQ(lattice.size(), matched.size());
    // Exact measure imposed: only the sum's rounding is left.
    EXPECT_NEAR(total(matched), *shape.measure(), 1e-12 * *shape.measure());
    const double sub = lattice[0].measure;
    const double reach = std::sqrt(dimension) / cells_per_unit;
    for (std::size_t k = 0; k < matched.size(); ++k) {
      EXPECT_EQ(matched[k].position, lattice[k].position);
      // Far from the boundary the density is untouched: the common factor is within the error of the covered parts.
      if (shape.distance(matched[k].position) < -reach) {
        EXPECT_NEAR(matched[k].measure, sub, 2e-4 * sub);
      }
      // A right-angled corner at the centre of a sub-cell leaves it a quarter.
      EXPECT_GT(matched[k].measure, .24 * sub);
      EXPECT_LT(matched[k].measure, 3 * sub);
    }
  };
  for (const int cells : {10, 13, 25}) {
    check(Disk({{0, 0}}, .5), 2, cells);
    check(Disk({{.013, .021}}, .5), 2, cells);
    check(Ring({{.01, 0}}, .3, .6), 2, cells);
    check(Ellipse({{0, .01}}, {{.75, .5}}, .3), 2, cells);
    check(*plane_shapes()[8].shape, 2, 2 * cells);
    check(Rectangle({{-.51, -.52}}, {{.52, .53}}), 2, cells);
  }
  check(Sphere({{0, 0, 0}}, .5), 3, 10);
  check(Sphere({{.013, .02, -.01}}, .5), 3, 12);
  check(Cylinder({{-.3, -.4, -.5}}, {{.3, .4, .5}}, .5), 3, 10);
}

TEST(Fill, CoveredMeasureWithoutAClosedForm) {
  // A grid of 20 sub-cells across the unit: promised below 1e-4.
  const std::array<int, 3> two{2, 2, 2};
  const FillGrid plane = grid_around_origin(2, 10), space = grid_around_origin(3, 10);
  const auto expect = [&](const Shape& shape, const FillGrid& grid, double exact, const std::string& name) {
    EXPECT_NEAR(covered_measure(shape, grid, two), exact, 1e-4 * exact) << name;
    EXPECT_NEAR(total(fill_shape(shape, grid, two, FillMeasure::matched)), exact, 1e-4 * exact) << name;
  };
  for (const auto& [name, shape] : plane_shapes()) {
    const Union hidden({shape, make<Point>(Vec<3>{{0, 0, 0}}, 2)});
    ASSERT_FALSE(hidden.measure());
    if (name.find("ring") == std::string::npos && name.find("polygon") == std::string::npos) {
      expect(hidden, plane, *shape->measure(), name);
    }
    EXPECT_NEAR(covered_measure(*shape, plane, two), *shape->measure(), 1e-4 * *shape->measure()) << name;
  }
  for (const auto& [name, shape] : solid_shapes())
    EXPECT_NEAR(covered_measure(*shape, space, two), *shape->measure(), 1e-4 * *shape->measure()) << name;

  const ShapePtr plate = make<Rectangle>(Vec<2>{{-.52, -.57}}, Vec<2>{{.61, .63}}), hole = make<Disk>(Vec<2>{{.05, 0}}, .3);
  expect(Difference(plate, {hole}), plane, 1.13 * 1.2 - pi * .09, "plate with a hole");
  // Two halves that share an edge off the lattice: the seam must not count as a boundary.
  expect(Union({make<Rectangle>(Vec<2>{{-.52, -.57}}, Vec<2>{{.0123, .63}}), make<Rectangle>(Vec<2>{{.0123, -.57}}, Vec<2>{{.61, .63}})}),
         plane, 1.13 * 1.2, "two halves");
  // Lens of two unit-half disks whose centres are d apart.
  const double r = .6, d = .5;
  expect(Intersection({make<Disk>(Vec<2>{{-d / 2, .01}}, r), make<Disk>(Vec<2>{{d / 2, .01}}, r)}), plane,
         2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d), "lens");
  // Cut by the grid's edge: what is inside counts.
  expect(Disk({{-1, 0}}, .7), plane, pi * .49 / 2, "half a disk outside the grid");
  // A plane shape in space is a prism, here cut by the grid: its area is not its volume.
  expect(Disk({{0, 0}}, .7), space, pi * .49 * 2, "prism");
}

TEST(Fill, EmptyAndOutside) {
  const FillGrid grid = grid_around_origin(2, 5);
  EXPECT_TRUE(fill_shape(Disk({{5, 5}}, 1), grid, {2, 2, 1}, FillMeasure::matched).empty());
  EXPECT_TRUE(fill_shape(Intersection({make<Disk>(Vec<2>{{-.5, 0}}, .2), make<Disk>(Vec<2>{{.5, 0}}, .2)}), grid, {2, 2, 1}).empty());
  EXPECT_EQ(fill_shape(Everywhere(), grid, {2, 2, 1}).size(), 400u);
  EXPECT_EQ(fill_shape(HalfPlane({{0, 0, 0}}, {{1, 0, 0}}, 2), grid, {2, 2, 1}).size(), 200u);
}

TEST(PlaneCut, FractionAgreesWithSampling) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const int dimension : {2, 3}) {
    for (int trial = 0; trial < 50; ++trial) {
      Vec<3> n{{number(random), number(random), dimension == 3 ? number(random) : 0}};
      n = normalized(n);
      const Vec<3> half{{.5, 1, .7}};
      const double d = .8 * number(random);
      const int m = dimension == 2 ? 400 : 60;
      int inside = 0, samples = 0;
      for (int k = 0; k < (dimension == 3 ? m : 1); ++k)
        for (int j = 0; j < m; ++j)
          for (int i = 0; i < m; ++i, ++samples) {
            const Vec<3> x{{half[0] * ((2 * i + 1.) / m - 1), half[1] * ((2 * j + 1.) / m - 1), half[2] * ((2 * k + 1.) / m - 1)}};
            inside += d + dot(n, x) - (dimension == 2 ? n[2] * x[2] : 0) <= 0;
          }
      // Sampling: at worst about one row of m.
      EXPECT_NEAR(plane_cut_fraction(d, n, half, dimension), double(inside) / samples, 2. / m);
    }
  }
  EXPECT_DOUBLE_EQ(plane_cut_fraction(.25, {{1, 0, 0}}, {{.5, .5, .5}}, 3), .25);
  EXPECT_DOUBLE_EQ(plane_cut_fraction(0, {{1, 1, 1}}, {{.5, .5, .5}}, 3), .5);
}

TEST(Arc, EndPointsAndChords) {
  const auto points = divide_arc({{1, 2}}, 2, 0, pi / 2, 6);
  ASSERT_EQ(points.size(), 7u);
  EXPECT_EQ(points.front(), (Vec<2>{{3, 2}}));
  EXPECT_EQ(points.back(), (Vec<2>{{1, 4}}));
  const double chord = norm(points[1] - points[0]);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    EXPECT_NEAR(norm(points[k + 1] - points[k]), chord, 1e-14);
    EXPECT_NEAR(norm(points[k] - Vec<2>{{1, 2}}), 2, 1e-15);
  }
  const auto clockwise = divide_arc({{0, 0}}, 1, pi, pi / 2, 3);
  EXPECT_EQ(clockwise.front(), (Vec<2>{{-1, 0}}));
  EXPECT_EQ(clockwise.back(), (Vec<2>{{0, 1}}));
  EXPECT_GT(clockwise[1][1], 0);
  const auto circle = divide_arc({{.1, .2}}, .3, .4, .4 + 2 * pi, 12);
  EXPECT_EQ(circle.front(), circle.back());
  const int n = count_arc_segments(2, 0, pi, .1);
  EXPECT_LE(norm(divide_arc({}, 2, 0, pi, n)[1] - Vec<2>{{2, 0}}), .1);
  EXPECT_GT(norm(divide_arc({}, 2, 0, pi, n - 1)[1] - Vec<2>{{2, 0}}), .1);
  EXPECT_THROW(divide_arc({}, 1, 0, 1, 0), std::invalid_argument);
  EXPECT_THROW(divide_arc({}, 0, 0, 1, 2), std::invalid_argument);
}

RC_GTEST_PROP(PolylineProperty, DividesEvenlyAndKeepsVertices, ()) {
  const auto raw =
      *rc::gen::container<std::vector<std::pair<int, int>>>(rc::gen::pair(rc::gen::inRange(-99, 99), rc::gen::inRange(-99, 99)));
  const double longest = *rc::gen::inRange(1, 50) * .1;
  std::vector<Vec<2>> points;
  for (const auto& [x, y] : raw) points.push_back({{x * .1, y * .1}});
  const auto divided = divide_polyline(points, longest);
  std::size_t next = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    // Every given vertex reappears bit by bit, and the way from one to the next is in equal steps.
    std::size_t parts = 0;
    if (k > 0) {
      const double length = norm(points[k] - points[k - 1]);
      parts = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / longest * (1 - 1e-9))));
      for (std::size_t i = next; i < next + parts; ++i)
        RC_ASSERT(std::abs(norm(divided[i + 1] - divided[i]) - length / static_cast<double>(parts)) < 1e-13);
    }
    next += parts;
    RC_ASSERT(divided.at(next) == points[k]);
  }
  RC_ASSERT(divided.size() == (points.empty() ? 0 : next + 1));
  RC_ASSERT(divided.empty() || divided.size() >= points.size());
}

TEST(Polyline, WholeNumbersOfSegmentsStay) {
  EXPECT_EQ(divide_polyline<2>({{{0, 0}}, {{.3, 0}}}, .1).size(), 4u);  // 0.3/0.1 is 2.9999999999999996 or so either way
  EXPECT_EQ(divide_polyline<3>({{{0, 0, 0}}, {{0, 0, 1.2}}}, .4).size(), 4u);
  EXPECT_THROW(divide_polyline<2>({{{0, 0}}, {{1, 0}}}, 0), std::invalid_argument);
}

std::vector<std::string> csv_errors(const std::string& text, int dimension = 2) {
  try {
    parse_particles_csv(text, "p.csv", dimension);
  } catch (const InputError& error) {
    std::vector<std::string> texts;
    for (const Diagnostic& d : error.diagnostics()) texts.push_back(d.text());
    return texts;
  }
  return {};
}

TEST(ParticlesCsv, ReadsColumnsInAnyOrderWithUnits) {
  const auto list = parse_particles_csv(
      "# a body\r\n\r\n volume[mm3] , y[mm],x, vy, vx[mm/s] \r\n1e-3, 18,+0.1,-2,3 # first\r\n\r\n  # nothing\r\n2,36,.2,0,0\r\n", "p.csv",
      2);
  ASSERT_EQ(list.particles.size(), 2u);
  EXPECT_TRUE(list.has_velocity);
  EXPECT_EQ(list.particles[0].position, (Vec<3>{{.1, .018, 0}}));
  EXPECT_EQ(list.particles[0].volume, 1e-12);
  EXPECT_EQ(list.particles[0].velocity, (Vec<3>{{.003, -2, 0}}));
  EXPECT_EQ(list.particles[0].line, 4);
  EXPECT_EQ(list.particles[1].line, 7);
  const auto space = parse_particles_csv("\xEF\xBB\xBFz,y,x,volume\n3,2,1,4", "p.csv", 3);
  EXPECT_FALSE(space.has_velocity);
  EXPECT_EQ(space.particles.at(0).position, (Vec<3>{{1, 2, 3}}));
}

RC_GTEST_PROP(ParticlesCsvProperty, KeepsEveryBit, (const std::vector<std::uint64_t>& bits)) {
  std::vector<double> values{.1, 1. / 3, 5e-324, 1.7976931348623157e308};
  for (const std::uint64_t b : bits)
    if (const double v = std::bit_cast<double>(b); std::isfinite(v)) values.push_back(v);
  std::string text = "x,y,volume\n";
  const auto written = [](double v) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.17g", v);
    return std::string(buffer);
  };
  for (const double v : values) text += written(v) + "," + written(-v) + ",1\n";
  const auto list = parse_particles_csv(text, "p.csv", 2);
  RC_ASSERT(list.particles.size() == values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    RC_ASSERT(std::bit_cast<std::uint64_t>(list.particles[k].position[0]) == std::bit_cast<std::uint64_t>(values[k]));
    RC_ASSERT(list.particles[k].position[1] == -values[k]);
  }
}

TEST(ParticlesCsv, TellsAllErrorsWithTheirPlaces) {
  const auto errors = csv_errors("# c\nx,y,volume\n1,2,3\n1, abc ,3\n1,nan,-3\r\n1,2\n1,2,3,4\n1,,0\n1e999,2mm,3\n");
  ASSERT_EQ(errors.size(), 9u);
  EXPECT_EQ(errors[0],
            "p.csv:4:4: y: \"abc\" is not a number (every value is a plain decimal number); write it as 1.5 or 1.5e-3, with the "
            "unit in the header as name[unit]");
  EXPECT_EQ(errors[1], "p.csv:5:3: y: nan is not finite (a particle has a place, a volume and a velocity); write a finite number");
  EXPECT_EQ(errors[2], "p.csv:5:7: volume: the volume is negative (-3 leaves the particle without mass); give a volume above 0");
  EXPECT_EQ(errors[3],
            "p.csv:6:4: 2 values where the header names 3 columns (it is not clear which is which); give one value for each column");
  EXPECT_EQ(errors[4].substr(0, 20), "p.csv:7:7: 4 values ");
  EXPECT_EQ(errors[5].substr(0, 33), "p.csv:8:3: y: the value is missin");
  EXPECT_EQ(errors[6].substr(0, 38), "p.csv:8:4: volume: the volume is zero ");
  EXPECT_EQ(errors[7].substr(0, 41), "p.csv:9:1: x: 1e999 does not fit a double");
  EXPECT_EQ(errors[8].substr(0, 39), "p.csv:9:7: y: \"2mm\" is not a number (ev");
}

TEST(ParticlesCsv, ReportsHeadersAndFiles) {
  EXPECT_EQ(csv_errors("").at(0),
            "p.csv: the file has no header line (it is empty or all comments); start it with a line such as \"x,y,volume\"");
  EXPECT_EQ(csv_errors("# only\n").size(), 1u);
  EXPECT_EQ(csv_errors("x,y,volume\n# none\n").at(0),
            "p.csv: the file has no particles (a body needs at least one); add a line for each particle below the header");
  EXPECT_EQ(csv_errors("x,y,z,volume\n1,2,3,4").at(0).substr(0, 56), "p.csv:1:5: \"z\" is not a column of a particle file (the pr");
  EXPECT_EQ(csv_errors("x,y\n1,2").at(0).substr(0, 36), "p.csv:1:1: column volume is missing ");
  EXPECT_EQ(csv_errors("x,y,volume,vx\n1,2,3,4").at(0).substr(0, 32), "p.csv:1:1: column vy is missing ");
  EXPECT_EQ(csv_errors("x,x,y,volume\n").at(0).substr(0, 36), "p.csv:1:3: x: column x appears twice");
  EXPECT_EQ(csv_errors("x,y,volume,mass\n").at(0).substr(0, 30), "p.csv:1:12: \"mass\" is not a co");
  EXPECT_EQ(csv_errors("x[mm,y,volume\n").at(0).substr(0, 40), "p.csv:1:1: \"x[mm\" has no closing bracket");
  EXPECT_EQ(csv_errors("x[s],y[furlongg],volume\n").size(), 2u) << "wrong dimension, unknown unit";
  EXPECT_EQ(csv_errors("1,2,3\n").at(0).substr(0, 20), "p.csv:1:1: \"1\" is no");
  std::string long_text = "x,y,volume\n";
  for (int k = 0; k < 1000; ++k) long_text += "a,0,1\n";
  EXPECT_EQ(csv_errors(long_text).size(), 51u);
  EXPECT_EQ(csv_errors(long_text).back(), "p.csv: and 950 more errors; mend these first");
}

TEST(ParticlesCsv, MissingFileIsReportedWhereItIsNamed) {
  const auto error_of = [](const std::string& path, const Location& at) -> std::string {
    try {
      read_particles_csv(path, 2, at);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of("no/such.csv", {"in.toml", 7, 3, "body[0].particles"}),
            "in.toml:7:3: body[0].particles: cannot read the particle file \"no/such.csv\" (No such file or directory); correct the path "
            "(relative to the input file) or make the file");
  const auto folder = std::filesystem::temp_directory_path();
  EXPECT_NE(error_of(folder.string(), {}).find("it is a folder"), std::string::npos);
  const auto file = folder / ("crampon_geometry_test_" + std::to_string(std::random_device{}()) + ".csv");
  std::ofstream(file, std::ios::binary) << "x,y,volume\n1,2,3\n";
  EXPECT_EQ(read_particles_csv(file.string(), 2).particles.size(), 1u);
  std::ofstream(file, std::ios::binary | std::ios::trunc);
  EXPECT_NE(error_of(file.string(), {}).find("no header line"), std::string::npos);
  std::filesystem::remove(file);
}

// What a parser does with one alternative: sets keys by name, checks, builds.
struct Built {
  ShapePtr shape;
  std::vector<std::string> errors;
};
Built build(const std::string& kind, const std::map<std::string, EntryValue>& values,
            const std::map<std::string, std::vector<ShapePtr>>& parts = {}) {
  const Alternative* alternative = shapes().find(kind);
  if (!alternative) return {nullptr, {"no such kind"}};
  const auto object = alternative->record->create();
  for (const auto& [key, value] : values) alternative->record->find(key)->set(object.get(), value);
  for (const auto& [key, list] : parts)
    for (const ShapePtr& part : list) alternative->record->find(key)->assign(object.get(), std::any(part));
  Diagnostics diagnostics;
  alternative->record->check(object.get(), diagnostics);
  Built built;
  for (const Diagnostic& d : diagnostics.list()) built.errors.push_back(d.text());
  if (built.errors.empty()) built.shape = std::any_cast<ShapePtr>(alternative->build(object.get()));
  return built;
}
using Numbers = std::vector<double>;
using Points = std::vector<Numbers>;

TEST(ShapeFamily, BuildsEveryKind) {
  const ShapePtr disk = build("disk", {{"centre", Numbers{1, 2}}, {"radius", 3.}}).shape;
  const ShapePtr rectangle = build("rectangle", {{"centre", Numbers{1, 2}}, {"size", Numbers{4, 2}}}).shape;
  std::map<std::string, Built> built;
  built["disk"].shape = disk;
  built["rectangle"].shape = rectangle;
  built["ellipse"] = build("ellipse", {{"centre", Numbers{1, 2}}, {"semi_axes", Numbers{2, 1}}, {"angle", 1.}});
  built["ring"] = build("ring", {{"centre", Numbers{1, 2}}, {"inner", 1.}, {"outer", 2.}});
  built["sector"] = build("sector", {{"centre", Numbers{1, 2}}, {"radius", 2.}, {"from", -1.}, {"to", 1.}});
  built["polygon"] = build("polygon", {{"corners", Points{{0, 0}, {1, 0}, {0, 1}}}});
  built["half_plane"] = build("half_plane", {{"point", Numbers{1, 2, 3}}, {"normal", Numbers{0, 0, 2}}});
  built["box"] = build("box", {{"low", Numbers{0, 0, 0}}, {"high", Numbers{1, 2, 3}}});
  built["sphere"] = build("sphere", {{"centre", Numbers{1, 2, 3}}, {"radius", 3.}});
  built["cylinder"] = build("cylinder", {{"from", Numbers{0, 0, 0}}, {"to", Numbers{0, 0, 2}}, {"radius", 1.}});
  built["point"] = build("point", {{"at", Numbers{1, 2}}});
  built["line"] = build("line", {{"from", Numbers{1, 2}}, {"to", Numbers{2, 2}}});
  built["everywhere"] = build("everywhere", {});
  built["union"] = build("union", {}, {{"of", {disk, rectangle}}});
  built["intersection"] = build("intersection", {}, {{"of", {disk, rectangle}}});
  built["difference"] = build("difference", {}, {{"of", {disk}}, {"without", {rectangle}}});
  built["rotated"] = build("rotated", {{"angle", pi / 2}, {"about", Numbers{1, 2}}}, {{"of", {rectangle}}});
  built["translated"] = build("translated", {{"by", Numbers{10, 0}}}, {{"of", {disk}}});
  for (const Alternative& a : shapes().alternatives()) {
    ASSERT_TRUE(built.contains(a.name())) << a.name();
    EXPECT_TRUE(built[a.name()].shape) << a.name();
    EXPECT_FALSE(a.record->help().empty());
  }
  EXPECT_EQ(shapes().alternatives().size(), built.size());
  EXPECT_EQ(shapes().tag_key(), "kind");
  EXPECT_TRUE(rectangle->contains({{3, 3, 0}}));
  EXPECT_FALSE(rectangle->contains({{3.1, 3, 0}}));
  EXPECT_TRUE(built["rotated"].shape->contains({{0, 4, 0}}));
  EXPECT_TRUE(built["translated"].shape->contains({{11, 2, 0}}));
  EXPECT_FALSE(built["difference"].shape->contains({{1, 2, 0}}));
  EXPECT_TRUE(built["difference"].shape->contains({{1, 4.5, 0}}));
  for (const char* kind : {"box", "sphere", "cylinder", "half_plane"}) EXPECT_EQ(built[kind].shape->dimension(), 3) << kind;
  for (const char* kind : {"disk", "polygon", "point", "line", "rotated"}) EXPECT_EQ(built[kind].shape->dimension(), 2) << kind;
}

TEST(ShapeFamily, ChecksAcrossKeys) {
  const auto first = [](const Built& built) { return built.errors.empty() ? std::string() : built.errors[0]; };
  EXPECT_EQ(first(build("ring", {{"centre", Numbers{0, 0}}, {"inner", 2.}, {"outer", 2.}})),
            "the inner radius is not below the outer one (2 m >= 2 m leaves no area); make inner smaller than outer");
  EXPECT_EQ(first(build("rectangle", {{"low", Numbers{0, 1}}, {"high", Numbers{1, 0}}})),
            "high is below low along y (0 < 1); exchange the two numbers");
  EXPECT_EQ(first(build("rectangle", {{"low", Numbers{0, 1}}})),
            "high is missing (the shape has no extent); give low and high, or centre and size");
  EXPECT_EQ(first(build("box", {})), "low and high are missing (the shape has no extent); give low and high, or centre and size");
  EXPECT_EQ(first(build("rectangle", {{"low", Numbers{0, 0}}, {"high", Numbers{1, 1}}, {"size", Numbers{1, 1}}})).substr(0, 28),
            "corners and centre with size");
  EXPECT_NE(first(build("sector", {{"centre", Numbers{0, 0}}, {"radius", 1.}, {"from", 1.}, {"to", 0.}})), "");
  EXPECT_NE(first(build("sector", {{"centre", Numbers{0, 0}}, {"radius", 1.}, {"from", 0.}, {"to", 7.}})), "");
  EXPECT_NE(first(build("half_plane", {{"point", Numbers{0, 0}}, {"normal", Numbers{0, 0}}})), "");
  EXPECT_NE(first(build("half_plane", {{"point", Numbers{0, 0}}, {"normal", Numbers{0, 0, 1}}})), "");
  EXPECT_NE(first(build("cylinder", {{"from", Numbers{0, 0, 0}}, {"to", Numbers{0, 0, 0}}, {"radius", 1.}})), "");
  EXPECT_NE(first(build("rotated", {{"axis", Numbers{0, 0, 0}}, {"about", Numbers{0, 0, 0}}}, {{"of", {make<Everywhere>()}}})), "");
  EXPECT_NE(first(build("line", {{"from", Numbers{0, 0}}, {"to", Numbers{0, 0, 1}}})), "");
  EXPECT_EQ(
      first(build("polygon", {{"corners", Points{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}})),
      "the polygon crosses itself: the edge from corner 1 meets the edge from corner 3 (such loops do not bound an area); list each corner "
      "once, in order along the boundary");
  EXPECT_FALSE(shapes().find("disk")->record->find("radius")->bounds.contains(0)) << "a radius of zero";
}

}  // namespace
}  // namespace crampon
