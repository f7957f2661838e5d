/// Contact on cells whose sides differ: how far apart faces read, at any angle, up to their ends.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "crampon/contact/outline_gap.hpp"
#include "run_case.hpp"

namespace crampon::test {
namespace {

/// Two blocks of particles in rows along their faces, turned by an angle, a gap apart, as nodes about the faces see them: what lies within
/// `reach` cells of the node. The normal is off by up to 30 degrees, as regressions are at the ends.
TEST(OutlineGap, IsExactForTurnedFacesUpToTheirEnds) {
  std::mt19937 random(1);
  const auto between = [&](double low, double high) { return low + (high - low) * static_cast<double>(random()) / 4294967296.; };
  double worst = 0;
  int nodes = 0;
  for (const Vec<2> cell : {Vec<2>{{0.1, 0.1}}, Vec<2>{{0.2, 0.1}}, Vec<2>{{0.4, 0.1}}, Vec<2>{{0.1, 0.4}}}) {
    for (int degrees = 0; degrees < 180; degrees += 7) {
      for (const double gap : {-0.01, 0., 0.05, 0.15}) {
        for (const double reach : {1., 1.25, 1.5}) {
          const double turn = degrees * std::numbers::pi / 180, long_side = std::fmax(cell[0], cell[1]);
          const Vec<2> n{{std::cos(turn), std::sin(turn)}}, t{{-n[1], n[0]}};
          const Vec<2> size{{between(0.03, 0.1), between(0.03, 0.1)}};
          const Vec<2> node{{between(-1, 1) * long_side, between(-1, 1) * long_side}};
          const int wide = static_cast<int>(between(1, 4) * long_side / size[1]) + 1;
          std::vector<OutlinedParticle<2>> seen;
          int of_a = 0, of_b = 0;
          double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
          for (int s = 0; s < 2; ++s) {
            for (int i = 0; i < 40; ++i) {
              for (int j = 0; j < wide; ++j) {
                const double along = (j + 0.5 - 0.5 * wide) * size[1];
                const double out = (s == 0 ? -1 : 1) * (0.5 * gap + (i + 0.5) * size[0]);
                const Vec<2> x = n * out + t * along - node;
                if (std::fabs(x[0]) >= reach * cell[0] || std::fabs(x[1]) >= reach * cell[1]) continue;
                seen.push_back({x, {n * (0.5 * size[0]), t * (0.5 * size[1])}, 1, s == 0 ? ContactSide::a : ContactSide::b});
                ++(s == 0 ? of_a : of_b);
                low[s] = std::fmin(low[s], along - 0.5 * size[1]);
                high[s] = std::fmax(high[s], along + 0.5 * size[1]);
              }
            }
          }
          // The first rows of both, and pieces that face each other.
          if (of_a == 0 || of_b == 0 || std::fmin(high[0], high[1]) <= std::fmax(low[0], low[1]) + 1e-9) continue;
          double first[2] = {HUGE_VAL, HUGE_VAL};
          for (const auto& p : seen) {
            double& f = first[p.side == ContactSide::a ? 0 : 1];
            f = std::fmin(f, std::fabs(dot(p.x + node, n)) - 0.5 * size[0] - 0.5 * gap);
          }
          if (std::fmax(first[0], first[1]) > 1e-9) continue;
          const double off = turn + between(-0.5, 0.5);
          const Vec<2> directions[] = {Vec<2>{{std::cos(off), std::sin(off)}}};
          const double error = outline_gap<2>(seen, directions) - gap;
          worst = std::fmax(worst, std::fabs(error) / std::fmin(cell[0], cell[1]));
          ++nodes;
        }
      }
    }
  }
  EXPECT_GT(nodes, 300);
  EXPECT_LT(worst, 1e-12);  // of the shorter side; 0.05 is asked for, and tables of mean positions err by 0.3 to 3
}

TEST(OutlineGap, IsExactInSpace) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  const Vec<3> n{{c * c, s * c, s}}, t{{-s, c, 0}}, u{{-c * s, -s * s, c}};
  std::vector<OutlinedParticle<3>> seen;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < 3; ++i) {
      for (int j = -2; j < 2; ++j) {
        for (int k = -3; k < 3; ++k) {
          const double out = (side == 0 ? -1 : 1) * (0.01 + 0.03 * (i + 0.5));
          seen.push_back({n * out + t * (0.05 * (j + 0.5)) + u * (0.02 * (k + 0.5)),
                          {n * 0.015, t * 0.025, u * 0.01},
                          1,
                          side == 0 ? ContactSide::a : ContactSide::b});
        }
      }
    }
  }
  const Vec<3> directions[] = {Vec<3>{{1, 0, 0}}, Vec<3>{}};
  EXPECT_NEAR(outline_gap<3>(seen, directions), 0.02, 1e-14);
}

struct Case {
  const char* shape_functions;
  double long_side, short_side;  ///< of the cells, x and y, m
  double degrees;                ///< of the normal of the faces to the axis x
  double early, late;            ///< most that contact may come before and after the faces touch, shorter sides of a cell
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.shape_functions << ", cells of " << c.long_side << " x " << c.short_side << " m, " << c.degrees << " degrees";
}

/// Blocks of square particles on the grid's sub-lattice approach along their common normal. Oblique faces of such blocks are staircases of particles
/// of half the shorter side, whose teeth reach out by 0.35 of it; what counts is the surface of the shapes.
class LongCells : public testing::TestWithParam<Case> {};
TEST_P(LongCells, MeetWhenTheyTouch) {
  const Case& c = GetParam();
  const double h = std::fmin(c.long_side, c.short_side), gap = 0.2;
  const double turn = c.degrees * std::numbers::pi / 180, co = std::cos(turn), si = std::sin(turn);
  const auto block = [&](const char* name, double left, double right, double v) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmaterial = \"m\"\nvelocity = [{}, {}]\nparticles_per_cell = [{}, {}]\nshape = {{ kind = \"rotated\", "
        "angle = "
        "\"{} deg\", about = [0, 0], of = {{ kind = \"rectangle\", low = [{}, -1], high = [{}, 1] }} }}\n",
        name, v * co, v * si, static_cast<int>(std::lround(2 * c.long_side / h)), static_cast<int>(std::lround(2 * c.short_side / h)),
        c.degrees, left, right);
  };
  const auto s = make(fmt::format(R"(
[grid]
origin = [-4, -4]
size = [8, 8]
cell = [{}, {}]
[time]
end = 0.16
courant = 0.3
[method]
shape_functions = "{}"
[contact]
fields = "bodies"
[[material]]
name = "m"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
)",
                                  c.long_side, c.short_side, c.shape_functions) +
                      block("a", -1.6, -0.5 * gap, 1) + block("b", 0.5 * gap, 1.6, -1));
  const double start = value(*s, "kinetic_energy");
  double met = HUGE_VAL;
  run(*s, [&](Simulation&) {
    if (met == HUGE_VAL && value(*s, "strain_energy") > 1e-6 * start) met = s->time();
  });
  const double left = (gap - 2 * met) / h;
  fmt::print("contact begins {:.3f} shorter sides before touch\n", left);
  EXPECT_LT(left, c.early);
  EXPECT_GT(left, -c.late);
}
std::vector<Case> cases() {
  std::vector<Case> out;
  for (const char* shape : {"linear", "gimp", "bspline"}) {
    for (const auto& [x, y] : {std::pair{0.4, 0.1}, {0.1, 0.4}, {0.2, 0.1}}) {
      // The way of a step, 3 to 4 % of a shorter side at these speeds, adds to what is found.
      for (const double degrees : {0., 7., 20., 33., 45., 60., 80., 90.}) out.push_back({shape, x, y, degrees, 0.09, 0.05});
    }
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Sweep, LongCells, testing::ValuesIn(cases_for(Runs::every, cases())));
INSTANTIATE_TEST_SUITE_P(SweepFull, LongCells, testing::ValuesIn(cases_for(Runs::full, cases())));

}  // namespace
}  // namespace crampon::test
