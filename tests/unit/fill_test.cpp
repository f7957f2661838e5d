#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "crampon/geometry/plane_cut.hpp"
#include "geometry_cases.hpp"

namespace crampon {
namespace {

using namespace testing;

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

// Particles by the sub-cell of the lattice of spacing s about `centre` in which they lie; places are odd, so that mirroring about 0 is a change
// of sign.
std::map<std::array<long, 3>, FilledParticle> by_place(const std::vector<FilledParticle>& particles, const Vec<3>& centre, double s) {
  std::map<std::array<long, 3>, FilledParticle> places;
  for (const FilledParticle& p : particles) {
    std::array<long, 3> place{};
    for (int k = 0; k < 3; ++k) place[k] = 2 * std::lround(std::floor((p.position[k] - centre[k]) / s)) + 1;
    places[place] = {p.position - centre, p.measure};
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
      const std::vector<std::pair<RegionPtr, const FillGrid*>> cases{
          {make<Disk>(Vec<2>{{.7, .7}}, radius), &plane},
          {make<Ellipse>(Vec<2>{{.7, .7}}, Vec<2>{{radius, .6 * radius}}), &plane},
          {make<Ring>(Vec<2>{{.7, .7}}, .4 * radius, radius), &plane},
          {make<Difference>(make<Rectangle>(Vec<2>{{.7 - radius, .7 - radius}}, Vec<2>{{.7 + radius, .7 + radius}}),
                            std::vector<RegionPtr>{make<Disk>(Vec<2>{{.7, .7}}, radius / 2)}),
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
            ASSERT_EQ(found->second.measure, value.measure) << "to the last bit";
            Vec<3> image = value.position;
            image[axis] = -image[axis];
            ASSERT_LT(norm(found->second.position - image), 1e-15) << "m";
          }
      }
    }
  }
}

TEST(Fill, MatchedMeasureAndMiddleAreTheShapesAndStaySmooth) {
  // Ten cells of 2 x 2 (2 x 2 x 2) particles across, and more.
  const auto check = [](const Region& shape, const std::optional<Vec<3>>& middle, int dimension, int cells_per_unit) {
    const FillGrid grid = grid_around_origin(dimension, cells_per_unit);
    const auto lattice = fill_shape(shape, grid, {2, 2, 2});
    const auto matched = fill_shape(shape, grid, {2, 2, 2}, FillMeasure::matched);
    ASSERT_GE(matched.size(), lattice.size());  // sub-cells that the shape covers by a fifth have particles as well
    // Exact measure imposed: only the sum's rounding is left.
    EXPECT_NEAR(total(matched), *shape.measure(), 1e-12 * *shape.measure());
    const double sub = lattice[0].measure;
    const double reach = std::sqrt(dimension) / cells_per_unit;
    Vec<3> moment;
    for (const FilledParticle& p : matched) moment += p.position * p.measure;
    // Whole numbers of 6e-8 of a sub-cell, and boundaries cut as planes.
    if (middle) {
      EXPECT_LT(norm(moment * (1 / *shape.measure()) - *middle), 2e-4 / cells_per_unit);
    }
    for (const FilledParticle& p : matched) {
      // The middle of what a particle stands for at a re-entrant corner lies outside: of the polygon here, by a tenth of a sub-cell.
      EXPECT_LT(shape.distance(p.position), (middle ? 1e-3 : 0.1) * reach);
      // Far from the boundary the density is untouched: the common factor is within the error of the covered parts.
      if (shape.distance(p.position) < -reach) {
        EXPECT_NEAR(p.measure, sub, 2e-4 * sub);
      }
      // At least a fifth of a sub-cell, and no more than its own and less than a fifth of those about it.
      EXPECT_GT(p.measure, .199 * sub);
      EXPECT_LT(p.measure, 1.6 * sub);
    }
  };
  for (const int cells : {10, 13, 25}) {
    check(Disk({{0, 0}}, .5), Vec<3>{}, 2, cells);
    check(Disk({{.013, .021}}, .5), Vec<3>{{.013, .021, 0}}, 2, cells);
    check(Ring({{.01, 0}}, .3, .6), Vec<3>{{.01, 0, 0}}, 2, cells);
    check(Ellipse({{0, .01}}, {{.75, .5}}, .3), Vec<3>{{0, .01, 0}}, 2, cells);
    check(*plane_shapes()[8].shape, std::nullopt, 2, 2 * cells);
    check(Rectangle({{-.51, -.52}}, {{.52, .53}}), Vec<3>{{.005, .005, 0}}, 2, cells);
  }
  check(Sphere({{0, 0, 0}}, .5), Vec<3>{}, 3, 10);
  check(Sphere({{.013, .02, -.01}}, .5), Vec<3>{{.013, .02, -.01}}, 3, 12);
  check(Cylinder({{-.3, -.4, -.5}}, {{.3, .4, .5}}, .5), Vec<3>{}, 3, 10);
}

TEST(Fill, CoveredMeasureWithoutAClosedForm) {
  // A grid of 20 sub-cells across the unit: promised below 1e-4.
  const std::array<int, 3> two{2, 2, 2};
  const FillGrid plane = grid_around_origin(2, 10), space = grid_around_origin(3, 10);
  const auto expect = [&](const Region& shape, const FillGrid& grid, double exact, const std::string& name) {
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

  const RegionPtr plate = make<Rectangle>(Vec<2>{{-.52, -.57}}, Vec<2>{{.61, .63}}), hole = make<Disk>(Vec<2>{{.05, 0}}, .3);
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

TEST(PlaneCut, FractionAndMomentAgreeWithSampling) {
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
      Vec<3> moment;
      for (int k = 0; k < (dimension == 3 ? m : 1); ++k)
        for (int j = 0; j < m; ++j)
          for (int i = 0; i < m; ++i, ++samples) {
            const Vec<3> x{{half[0] * ((2 * i + 1.) / m - 1), half[1] * ((2 * j + 1.) / m - 1), half[2] * ((2 * k + 1.) / m - 1)}};
            if (d + dot(n, x) - (dimension == 2 ? n[2] * x[2] : 0) > 0) continue;
            ++inside;
            moment += x;
          }
      // Sampling: at worst about one row of m.
      const CoveredPart part = plane_cut(d, n, half, dimension);
      EXPECT_NEAR(part.fraction, double(inside) / samples, 2. / m);
      EXPECT_EQ(part.fraction, plane_cut_fraction(d, n, half, dimension));
      for (int k = 0; k < dimension; ++k) EXPECT_NEAR(part.moment[k], moment[k] / samples, 2. / m);
    }
  }
  EXPECT_DOUBLE_EQ(plane_cut_fraction(.25, {{1, 0, 0}}, {{.5, .5, .5}}, 3), .25);
  EXPECT_DOUBLE_EQ(plane_cut_fraction(0, {{1, 1, 1}}, {{.5, .5, .5}}, 3), .5);
  EXPECT_DOUBLE_EQ(plane_cut(.25, {{1, 0, 0}}, {{.5, .5, .5}}, 3).moment[0], .25 * -.375);
  // The corner beyond x + y + z = -1 of a cube from -1/2 to 1/2: a tetrahedron with edges of half the cube's.
  EXPECT_DOUBLE_EQ(plane_cut(1, {{1, 1, 1}}, {{.5, .5, .5}}, 3).moment[1], 1. / 48 * (-.5 + .125));
}

}  // namespace
}  // namespace crampon
