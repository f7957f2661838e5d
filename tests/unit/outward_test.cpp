/// The outward normals of shapes: the gradient of their distance, in closed form.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "crampon/geometry/angle.hpp"
#include "geometry_cases.hpp"

namespace crampon {
namespace {

using namespace testing;

std::vector<Named> single_shapes() {
  std::vector<Named> all = plane_shapes();
  for (Named& s : solid_shapes()) all.push_back(s);
  Corners backwards(notched.rbegin(), notched.rend());
  all.push_back({"clockwise polygon", make<Polygon>(backwards, std::vector<Corners>{Corners(notched_hole.rbegin(), notched_hole.rend())})});
  all.push_back({"circle as an ellipse", make<Ellipse>(Vec<2>{{.01, .02}}, Vec<2>{{.4, .4}}, .3)});
  all.push_back({"thin ellipse", make<Ellipse>(Vec<2>{{.01, .02}}, Vec<2>{{.6, .02}}, 1.2)});
  all.push_back({"whole sector", make<Sector>(Vec<2>{{.01, .02}}, .5, .2, .2 + 2 * pi)});
  all.push_back({"half disk", make<Sector>(Vec<2>{{.01, .02}}, .5, .2, .2 + pi)});
  all.push_back({"edge as a rectangle", make<Rectangle>(Vec<2>{{-.3, .1}}, Vec<2>{{.4, .1}})});
  all.push_back({"face as a box", make<Box>(Vec<3>{{-.3, .1, -.2}}, Vec<3>{{.4, .1, .3}})});
  all.push_back({"half-plane", make<HalfPlane>(Vec<3>{{.1, .2, 0}}, Vec<3>{{3, -4, 0}}, 2)});
  all.push_back({"half-space", make<HalfPlane>(Vec<3>{{.1, .2, .3}}, Vec<3>{{1, -2, 2}}, 3)});
  all.push_back({"point", make<Point>(Vec<3>{{.1, .2, .3}}, 2)});
  all.push_back({"point in space", make<Point>(Vec<3>{{.1, .2, .3}}, 3)});
  all.push_back({"line", make<Line>(Vec<3>{{-.1, .2, 0}}, Vec<3>{{.4, -.2, 0}}, 2)});
  all.push_back({"line in space", make<Line>(Vec<3>{{-.1, .2, -.3}}, Vec<3>{{.4, -.2, .1}}, 3)});
  return all;
}

std::vector<Named> combinations() {
  const std::vector<Named> plane = plane_shapes(), solid = solid_shapes();
  using Parts = std::vector<RegionPtr>;
  const RegionPtr joined = make<Union>(Parts{plane[0].shape, plane[1].shape, plane[3].shape});
  const RegionPtr holed = make<Difference>(plane[0].shape, Parts{plane[2].shape, make<Disk>(Vec<2>{{.3, .3}}, .1)});
  return {{"union", joined},
          {"intersection", make<Intersection>(Parts{plane[1].shape, plane[2].shape, plane[0].shape})},
          {"difference", holed},
          {"turned union", make<Rotated>(joined, .7, Vec<3>{{.1, -.2, 0}})},
          {"mirrored difference", make<Mirrored>(holed, std::size_t{1}, .15)},
          {"shifted difference", make<Translated>(holed, Vec<3>{{.1, -.2, 0}})},
          {"difference of a union", make<Difference>(joined, Parts{make<Rotated>(holed, 2., Vec<3>{})})},
          {"solids", make<Difference>(make<Union>(Parts{solid[0].shape, solid[1].shape}), Parts{solid[2].shape})},
          {"plane shape tilted in space", make<Rotated>(plane[0].shape, .8, Vec<3>{{0, .1, 0}}, Vec<3>{{1, .3, .2}})}};
}

class RandomPoints {
 public:
  Vec<3> operator()() { return {{coordinate_(random_), coordinate_(random_), coordinate_(random_)}}; }

 private:
  std::mt19937 random_{17};
  std::uniform_real_distribution<double> coordinate_{-1, 1};
};

// Whether the gradient of the distance jumps or turns sharply within a step of x along an axis, judged by distances alone.
bool near_kink(const Region& shape, const Vec<3>& x, double step) {
  for (std::size_t k = 0; k < 3; ++k) {
    Vec<3> e;
    e[k] = step;
    if (std::abs(shape.distance(x + e) - 2 * shape.distance(x) + shape.distance(x - e)) > 2e-6 * step) return true;
  }
  return false;
}

Vec<3> central_difference(const Region& shape, const Vec<3>& x, double step) {
  Vec<3> gradient;
  for (std::size_t k = 0; k < 3; ++k) {
    Vec<3> e;
    e[k] = step;
    gradient[k] = (shape.distance(x + e) - shape.distance(x - e)) / (2 * step);
  }
  return gradient;
}

TEST(Outward, IsTheGradientOfTheDistance) {
  std::vector<Named> all = single_shapes();
  for (Named& s : combinations()) all.push_back(s);
  RandomPoints point;
  double worst = 0;
  for (const auto& [name, shape] : all) {
    int compared = 0;
    const int points = 4000;
    const double step = 1e-8;
    for (int k = 0; k < points; ++k) {
      const Vec<3> x = point(), n = shape->outward(x);
      ASSERT_NEAR(norm(n), 1, 1e-15) << name;  // a few roundings
      if (shape->dimension() == 2) {
        ASSERT_EQ(n[2], 0) << name;
      }
      if (near_kink(*shape, x, step)) continue;
      ++compared;
      const double apart = norm(n - central_difference(*shape, x, step));
      worst = std::max(worst, apart);
      // Rounding of distances over the step, 1e-8, and a quarter of a step times the curvature where an edge ends and its corner begins.
      ASSERT_LT(apart, 1e-6) << name << " at " << x[0] << ", " << x[1] << ", " << x[2];
    }
    EXPECT_GT(compared, points * 9 / 10) << name;
  }
  RecordProperty("worst_against_differences", fmt::format("{:.1e}", worst));
}

TEST(Outward, LeadsToTheNearestBoundaryPoint) {
  RandomPoints point;
  for (const auto& [name, shape] : single_shapes()) {
    for (int k = 0; k < 4000; ++k) {
      const Vec<3> x = point();
      const Vec<3> on = x - shape->distance(x) * shape->outward(x);
      ASSERT_NEAR(shape->distance(on), 0, 1e-12) << name << " at " << x[0] << ", " << x[1] << ", " << x[2];
      // There, within round-off of the boundary, it is one of the boundary's normals: the way out is the shortest from there, or at
      // corners that point inwards the way in.
      const Vec<3> n = shape->outward(on);
      if (n == Vec<3>{}) continue;  // a point itself
      const double step = 1e-4;
      const bool out = std::abs(shape->distance(on + step * n) - step) < 1e-9;
      const bool in = std::abs(shape->distance(on - step * n) + step) < 1e-9;
      ASSERT_TRUE(out || in) << name << " at " << on[0] << ", " << on[1] << ", " << on[2];
    }
  }
}

// Points on the boundary exactly, with their normal.
struct OnBoundary {
  const char* name;
  RegionPtr shape;
  Vec<3> x, normal;
};

TEST(Outward, IsTheNormalOnTheBoundary) {
  using Parts = std::vector<RegionPtr>;
  const RegionPtr rectangle = make<Rectangle>(Vec<2>{{0, 0}}, Vec<2>{{4, 2}});
  const RegionPtr frame =
      make<Polygon>(loop({{0, 0}, {6, 0}, {6, 6}, {3, 6}, {0, 6}}), std::vector<Corners>{loop({{2, 3}, {3, 2}, {4, 3}, {3, 4}})});
  const double q = std::sqrt(.5);
  const RegionPtr step = make<Union>(Parts{rectangle, make<Rectangle>(Vec<2>{{4, 0}}, Vec<2>{{6, 1}})});
  const RegionPtr plate = make<Difference>(make<Rectangle>(Vec<2>{{0, 0}}, Vec<2>{{20, 20}}), Parts{make<Disk>(Vec<2>{{10, 10}}, 5.)});
  const RegionPtr punch = make<Intersection>(Parts{make<Disk>(Vec<2>{{0, 15}}, 15.), make<Rectangle>(Vec<2>{{-20, -1}}, Vec<2>{{20, 8}})});
  const OnBoundary cases[] = {
      {"rectangle, below", rectangle, {{1, 0, 7}}, {{0, -1, 0}}},
      {"rectangle, above", rectangle, {{1, 2, 7}}, {{0, 1, 0}}},
      {"rectangle, left", rectangle, {{0, .5, 7}}, {{-1, 0, 0}}},
      {"rectangle, right", rectangle, {{4, .5, 7}}, {{1, 0, 0}}},
      {"edge", make<Rectangle>(Vec<2>{{0, 1}}, Vec<2>{{4, 1}}), {{1, 1, 0}}, {{0, 1, 0}}},
      {"beyond a corner", rectangle, {{4 + 3e-9, 2 + 4e-9, 0}}, {{.6, .8, 0}}},
      {"quarter-turned rectangle", make<Rotated>(rectangle, pi / 2, Vec<3>{}), {{-2, 1, 0}}, {{-1, 0, 0}}},
      {"box", make<Box>(Vec<3>{{0, 0, 0}}, Vec<3>{{1, 2, 3}}), {{.5, 1, 3}}, {{0, 0, 1}}},
      {"disk", make<Disk>(Vec<2>{{1, 1}}, 5.), {{4, 5, 0}}, {{.6, .8, 0}}},
      {"ellipse, vertex", make<Ellipse>(Vec<2>{{0, 0}}, Vec<2>{{2, 1}}, pi / 2), {{0, 2, 0}}, {{0, 1, 0}}},
      {"ellipse, side", make<Ellipse>(Vec<2>{{0, 0}}, Vec<2>{{2, 1}}, pi / 2), {{-1, 0, 0}}, {{-1, 0, 0}}},
      {"ring, outside", make<Ring>(Vec<2>{{0, 0}}, 5., 13.), {{-5, 12, 0}}, {{-5. / 13, 12. / 13, 0}}},
      {"ring, inside", make<Ring>(Vec<2>{{0, 0}}, 5., 13.), {{3, 4, 0}}, {{-.6, -.8, 0}}},
      {"sector, arc", make<Sector>(Vec<2>{{0, 0}}, 5., 0., pi / 2), {{3, 4, 0}}, {{.6, .8, 0}}},
      {"sector, first edge", make<Sector>(Vec<2>{{0, 0}}, 5., 0., pi / 2), {{3, 0, 0}}, {{0, -1, 0}}},
      {"sector, last edge", make<Sector>(Vec<2>{{0, 0}}, 5., 0., pi / 2), {{0, 3, 0}}, {{-1, 0, 0}}},
      {"polygon, edge", frame, {{1, 0, 0}}, {{0, -1, 0}}},
      {"polygon, corner of 180 degrees", frame, {{3, 6, 0}}, {{0, 1, 0}}},
      {"polygon, beside it", frame, {{3 + 1e-16, std::nextafter(6., 7.), 0}}, {{0, 1, 0}}},
      {"polygon, hole", frame, {{2.5, 2.5, 0}}, {{q, q, 0}}},
      {"polygon, hole", frame, {{3.5, 3.5, 0}}, {{-q, -q, 0}}},
      {"line", make<Line>(Vec<3>{{0, 0, 0}}, Vec<3>{{1, 1, 0}}, 2), {{.3, .3, 0}}, {{-q, q, 0}}},
      {"line, beyond its end", make<Line>(Vec<3>{{0, 0, 0}}, Vec<3>{{1, 1, 0}}, 2), {{2, 2, 0}}, {{q, q, 0}}},
      {"half-plane", make<HalfPlane>(Vec<3>{{0, 1, 0}}, Vec<3>{{0, 2, 0}}, 2), {{5, 1, 0}}, {{0, 1, 0}}},
      {"sphere", make<Sphere>(Vec<3>{{0, 0, 0}}, 3.), {{1, 2, 2}}, {{1. / 3, 2. / 3, 2. / 3}}},
      {"cylinder, side", make<Cylinder>(Vec<3>{{0, 0, 0}}, Vec<3>{{0, 0, 2}}, 5.), {{3, 4, 1}}, {{.6, .8, 0}}},
      {"cylinder, end", make<Cylinder>(Vec<3>{{0, 0, 0}}, Vec<3>{{0, 0, 2}}, 5.), {{1, 2, 2}}, {{0, 0, 1}}},
      {"union, first", step, {{2, 2, 0}}, {{0, 1, 0}}},
      {"union, second", step, {{5, 1, 0}}, {{0, 1, 0}}},
      {"difference, hole", plate, {{13, 14, 0}}, {{-.6, -.8, 0}}},
      {"difference, rim", plate, {{20, 3, 0}}, {{1, 0, 0}}},
      {"intersection, arc", punch, {{9, 3, 0}}, {{.6, -.8, 0}}},
      {"intersection, top", punch, {{3, 8, 0}}, {{0, 1, 0}}},
  };
  for (const auto& [name, shape, x, normal] : cases) {
    const Vec<3> n = shape->outward(x);
    // 1e-6 at the corner that is nanometres away: the point itself is rounded to 1e-16.
    EXPECT_LT(norm(n - normal), name == std::string("beyond a corner") ? 1e-6 : 1e-14)
        << name << ": " << n[0] << ", " << n[1] << ", " << n[2];
  }
}

TEST(Outward, IsOneOfTheNormalsAtCornersOnTheMedialAxisAndNothingWithoutDirection) {
  // Exactly on corners, where a point beyond by the step along any of their normals is that far away.
  const Corners star = loop({{0, 0}, {4, 1}, {8, 0}, {6, 4}, {8, 8}, {4, 6}, {0, 8}, {1, 4}});
  const Polygon polygon(star);
  for (const Vec<2>& corner : star) {
    const Vec<3> x{{corner[0], corner[1], 0}}, n = polygon.outward(x);
    EXPECT_NEAR(norm(n), 1, 1e-15);
    const bool out = std::abs(polygon.distance(x + 1e-3 * n) - 1e-3) < 1e-14;
    const bool in = std::abs(polygon.distance(x - 1e-3 * n) + 1e-3) < 1e-14;
    EXPECT_TRUE(out || in) << corner[0] << ", " << corner[1];
  }
  for (const double x : {0., 4.}) {
    for (const double y : {0., 2.}) {
      const Rectangle rectangle({{0, 0}}, {{4, 2}});
      const Vec<3> n = rectangle.outward({{x, y, 0}});
      EXPECT_DOUBLE_EQ(rectangle.distance(Vec<3>{{x, y, 0}} + n), 1);
    }
  }
  // On medial axes: a normal of one of the nearest points.
  const Vec<3> middle{{2, 1, 0}};
  EXPECT_DOUBLE_EQ(Rectangle({{0, 0}}, {{4, 2}}).distance(middle + Rectangle({{0, 0}}, {{4, 2}}).outward(middle)), 0);
  EXPECT_DOUBLE_EQ(std::abs(Ellipse({{0, 0}}, {{.5, .2}}).outward({})[1]), 1);
  EXPECT_DOUBLE_EQ(std::abs(Ellipse({{0, 0}}, {{.2, .5}}).outward({{1e-300, 0, 0}})[0]), 1);
  const Sector wide({{0, 0}}, 1, 0, 1.5 * pi);
  EXPECT_LT(norm(wide.outward({{-.01, .01, 0}}) - Vec<3>{{std::sqrt(.5), -std::sqrt(.5), 0}}), 1e-14) << "the corner is nearest";
  EXPECT_EQ(wide.outward({}), (Vec<3>{{0, -1, 0}}));
  // Square roots of what underflows.
  EXPECT_EQ(Disk({{0, 0}}, 1).outward({{0, 1e-310, 0}}), (Vec<3>{{0, 1, 0}}));
  // Nothing to choose by.
  EXPECT_EQ(Everywhere().outward({{1, 2, 3}}), Vec<3>{});
  EXPECT_EQ(Disk({{1, 2}}, 3).outward({{1, 2, 9}}), Vec<3>{});
  EXPECT_EQ(Ring({{1, 2}}, 3, 4).outward({{1, 2, 9}}), Vec<3>{});
  EXPECT_EQ(Sphere({{1, 2, 3}}, 3).outward({{1, 2, 3}}), Vec<3>{});
  EXPECT_EQ(Point({{1, 2, 3}}, 2).outward({{1, 2, 9}}), Vec<3>{});
  EXPECT_EQ(Cylinder({{0, 0, 0}}, {{0, 0, 20}}, 1).outward({{0, 0, 10}}), Vec<3>{});
  // A line in space passes points without a side of their own: across it all the same.
  const Vec<3> n = Line({{0, 0, 0}}, {{1, 1, 1}}, 3).outward({{.3, .3, .3}});
  EXPECT_NEAR(norm(n), 1, 1e-15);
  EXPECT_NEAR(n[0] + n[1] + n[2], 0, 1e-15);
}

}  // namespace
}  // namespace crampon
