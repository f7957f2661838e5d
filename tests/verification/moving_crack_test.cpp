/// Validation row 60: a cracked body in free flight, and one that turns by 90 degrees.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double h = 0.0625;

class Translation : public testing::TestWithParam<const char*> {};

/// Twenty cells of flight: no stress, the crack exactly where the body is. The crack begins outside the body and meets a second one.
TEST_P(Translation, CarriesCracksAlong) {
  const auto simulation = make(fmt::format(R"(
[grid]
origin = [0, 0]
size = [4, 3]
cell = 0.0625
[time]
end = 0.625
step = 2e-3
[method]
shape_functions = "{}"
[[material]]
name = "m"
law = "elastic_small_strain"
E = 1e5
nu = 0.3
density = 1000
[[body]]
name = "block"
material = "m"
shape = {{ kind = "rectangle", low = [0.5, 0.5], high = [1.25, 1] }}
velocity = [2, 1]
[[crack]]
name = "edge"
points = [[0.41, 0.75], [0.95, 0.77]]
contact = {{ law = "coulomb", friction = 0.3 }}
[[crack]]
name = "inner"
points = [[0.8, 0.6], [0.78, 0.9]]
contact = {{ law = "frictionless" }}
)",
                                          GetParam()));
  const CrackFrame before = simulation->cracks();
  run(*simulation);
  const CrackFrame after = simulation->cracks();
  EXPECT_LT(largest(field(simulation->particles(), "stress").values), 1e-12 * 1e5);  // the row's bound, sigma/E
  for (const auto& [a, b] : {std::pair{&before.plane, &after.plane}, std::pair{&before.upper, &after.upper}, std::pair{&before.lower, &after.lower}}) {
    for (std::size_t v = 0; v < a->size() / 3; ++v) {
      EXPECT_NEAR((*b)[3 * v], (*a)[3 * v] + 1.25, 1e-3 * h);
      EXPECT_NEAR((*b)[3 * v + 1], (*a)[3 * v + 1] + 0.625, 1e-3 * h);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Shapes, Translation, testing::Values("linear", "gimp", "bspline"));

/// A disk of ten cells' radius turns once by 90 degrees with omega R / c = 0.01.
TEST(Rotation, TurnsCracksWithTheBody) {
  const double R = 10 * h, c = 10, omega = 0.01 * c / R, nu = 0.3;
  const auto simulation = make(fmt::format(R"(
[grid]
origin = [-1, -1]
size = [2, 2]
cell = 0.0625
[time]
end = {:.17g}
courant = 0.4
[method]
shape_functions = "gimp"
[[material]]
name = "m"
law = "elastic_large_rotation"
E = 1e5
nu = {}
density = 1000
[[body]]
name = "disk"
material = "m"
shape = {{ kind = "disk", centre = [0.01, 0.02], radius = {} }}
spin = [{:.17g}]
spin_centre = [0.01, 0.02]
[[crack]]
name = "crack"
points = [[-0.2, 0.03], [0.3, 0.01]]
contact = {{ law = "frictionless" }}
)",
                                          M_PI / 2 / omega, nu, R, omega));
  const CrackFrame before = simulation->cracks();
  double worst_stress = 0;
  run(*simulation, [&](Simulation& s) {
    if (s.steps_done() % 100 == 0) worst_stress = std::fmax(worst_stress, largest(field(s.particles(), "stress").values));
  });
  const CrackFrame after = simulation->cracks();
  // The row's bound: twice the stress of a disk that spins, (3 + nu)/8 (omega R/c)^2 E. The concentration at the crack's tips
  // (a = R/2.5) stays within the factor two on particles, which are a quarter of a cell away.
  EXPECT_LT(worst_stress / 1e5, 2 * (3 + nu) / 8 * 1e-4 * 1.5);
  for (std::size_t v = 0; v < before.plane.size() / 3; ++v) {
    const double x = before.plane[3 * v] - 0.01, y = before.plane[3 * v + 1] - 0.02;
    EXPECT_NEAR(after.plane[3 * v], 0.01 - y, 0.01 * h) << "vertex " << v;
    EXPECT_NEAR(after.plane[3 * v + 1], 0.02 + x, 0.01 * h) << "vertex " << v;
  }
}

}  // namespace
}  // namespace crampon::test
