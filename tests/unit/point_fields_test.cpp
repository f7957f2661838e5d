/// What a point of space sees of the velocity fields about it: those on its own side of all cracks.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "crampon/run/build_model.hpp"
#include "crampon/shape/registry.hpp"
#include "crampon/step/advance.hpp"
#include "crampon/step/point_fields.hpp"
#include "run_case.hpp"

namespace crampon::test {
namespace {

/// A block with a crack from its left edge to its middle, and one across that one, moved and turned a little.
std::string cracked_block(double dx, double dy, const std::string& shape_functions, const std::string& crack_shape_functions) {
  return fmt::format(R"(
analysis = "plane_strain"
[grid]
origin = [0, 0]
size = [0.4, 0.4]
cell = 0.01
[time]
steps = 1
step = 1e-13
[method]
stress_update = "musl"
rotation = "n03"
shape_functions = "{}"
crack_shape_functions = "{}"
[[material]]
name = "soft"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "block"
material = "soft"
shape = {{ kind = "rectangle", low = [0.1, 0.1], high = [0.3, 0.3] }}
[[crack]]
points = [[0.09, {}], [{}, {}]]
contact = {{ law = "frictionless" }}
)",
                     shape_functions, crack_shape_functions, 0.2 + dy, 0.2 + dx, 0.203 + dy);
}

struct Seen {
  BuiltModel<2> built;
  double slope = 0, y = 0, tip = 0;  ///< of the crack: y + slope x, up to x = tip
};

/// One step, so short that the crack moves by less than the hair beside it from which points look. Particles above the crack's line move with
/// (1, 2) m/s left of its tip, those below with (-3, 0.5); right of the tip all with (0, 0). Momenta are those of N03, of velocities alone.
constexpr Vec<2> above{{1, 2}}, below{{-3, 0.5}};
template <class Shape>
Seen stepped(double dx, double dy, const std::string& word, const std::string& crack_word) {
  Seen s{build_model<2>(read_problem_text(cracked_block(dx, dy, word, crack_word), "test.toml", "."), 1), 0, 0, 0.2 + dx};
  State<2>& state = s.built.state;
  s.slope = 0.003 / (0.11 + dx);
  s.y = 0.2 + dy - 0.09 * s.slope;
  for (std::size_t p = 0; p < state.particles.size(); ++p) {
    const Vec<2> x = state.particles.position(p);
    const bool beyond = x[0] > s.tip + 0.02;  // the nodes about the tip itself see both
    state.particles.set_motion(p, x, beyond ? Vec<2>{} : x[1] > s.y + s.slope * x[0] ? above : below);
  }
  advance<2, Shape>(state, s.built.work, s.built.model, 1e-13, Watched::no);
  return s;
}

class Points : public testing::TestWithParam<const char*> {};

TEST_P(Points, SeeTheFieldOnTheirSideOfACrack) {
  const std::string crack_word = GetParam();
  int whole = 0;
  for_each_shape([&]<class Shape>(std::type_identity<Shape>) {
    for (const double dx : {0., 0.0031, 0.0077}) {
      for (const double dy : {0., 0.0023, 0.0049, 0.0091}) {
        Seen s = stepped<Shape>(dx, dy, Shape::name, crack_word);
        const PointFields fields(s.built.work, s.built.model);
        const Vec<2> up = normalized(Vec<2>{{-s.slope, 1}});
        // Beside the crack, away from its tip and the edge of the body by the reach of all functions.
        for (double x = 0.13; x < s.tip - 0.045; x += 0.0037) {
          const Vec<2> on{{x, s.y + s.slope * x}};
          for (const bool is_above : {true, false}) {
            const Vec<2> from = fields.beside(on, is_above ? up : -up);
            const PointNodes<2> seen = fields.at(from, 0);
            double sum = 0;
            Vec<2> slopes, place;
            for (const PointNode<2>& n : seen) sum += n.S, slopes += n.G, place += n.x * n.S;
            // All particles of the field move alike: nodes do, and so does the point. Momenta are sums of some ten particles.
            ASSERT_GT(sum, 0.1) << Shape::name << " at " << x << (is_above ? " above" : " below");
            ASSERT_LT(norm(velocity_at<2>(s.built.work, seen) * (1 / sum) - (is_above ? above : below)), 1e-11)
                << Shape::name << " at " << x << (is_above ? " above" : " below");
            if (sum < 1 - 1e-9) continue;  // the outermost row of particles does not reach a node across
            ++whole;
            ASSERT_NEAR(sum, 1, 1e-12);
            // Slopes of functions that add up to one, on cells of 1 cm: round-off of 1/cell.
            ASSERT_LT(norm(slopes), 1e-9);
            ASSERT_LT(norm(place - from), 1e-12) << "linear functions are exact";
            for (const Vec<2>& row : velocity_gradient_at<2>(s.built.work, seen)) ASSERT_LT(norm(row), 1e-8);
            // The nodes across the crack are among them, with the field of this side.
            bool any_across = false;
            for (const PointNode<2>& n : seen) any_across = any_across || (n.x[1] > s.y + s.slope * n.x[0]) != is_above;
            EXPECT_TRUE(any_across);
          }
        }
        // Ahead of the crack there is one field, which both sides of its line see.
        const Vec<2> ahead{{s.tip + 0.065, s.y + s.slope * (s.tip + 0.065)}};
        for (const Vec<2>& out : {up, -up}) {
          double sum = 0;
          const PointNodes<2> seen = fields.at(fields.beside(ahead, out), 0);
          for (const PointNode<2>& n : seen) sum += n.S;
          EXPECT_NEAR(sum, 1, 1e-12);
          EXPECT_LT(norm(velocity_at<2>(s.built.work, seen)), 1e-12);
        }
      }
    }
  });
  EXPECT_GT(whole, 500) << "points whose nodes all have the field";
}

TEST_P(Points, SeeLessOfABodyAtItsEdge) {
  Seen s = stepped<LinearShape>(0, 0, "linear", GetParam());
  const PointFields fields(s.built.work, s.built.model);
  EXPECT_TRUE(fields.at({{0.35, 0.35}}, 0).empty()) << "far from all bodies";
  double inside = 0, outside = 0;
  for (const PointNode<2>& n : fields.at({{0.28, 0.25}}, 0)) inside += n.S;
  for (const PointNode<2>& n : fields.at({{0.306, 0.25}}, 0)) outside += n.S;
  EXPECT_NEAR(inside, 1, 1e-12);
  EXPECT_GT(outside, 0.1);  // the row of nodes on the edge
  EXPECT_LT(outside, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Functions, Points, testing::Values("linear", "same"));

}  // namespace
}  // namespace crampon::test
