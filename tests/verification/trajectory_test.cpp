/// Where bodies are at a time: positions lead velocities by half a step inside the engine and are taken back for all who look at them
/// (docs/theory/step.md, time of positions), so that trajectories are of second order in the time step.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "run_case.hpp"

namespace crampon::test {
namespace {

/// {shape functions, stress update, dimension}
using Setting = std::tuple<const char*, const char*, int>;
std::string name_of(const testing::TestParamInfo<Setting>& info) {
  const auto [shape, update, dimension] = info.param;
  return fmt::format("{}_{}_in_{}d", shape, update, dimension);
}

std::string head(const Setting& setting, double end, double step, const std::string& more = "") {
  const auto [shape, update, dimension] = setting;
  const bool space = dimension == 3;
  return fmt::format(R"(analysis = "{}"
[grid]
origin = [{}]
size = [{}]
cell = 0.1
[time]
end = {}
step = {}
[method]
shape_functions = "{}"
stress_update = "{}"
{}
[[material]]
name = "m"
law = "elastic_large_rotation"
E = 1e4
nu = 0.3
density = 1000
)",
                     space ? "three_dimensional" : "plane_strain", space ? "-1, -1, -1" : "-1, -1", space ? "2, 2, 2" : "2, 2", end, step,
                     shape, update, more);
}

/// Runs to the end in steps that are cut at odd times, as frames cut them.
void run_cut(Simulation& simulation, const std::function<void(Simulation&)>& each = {}) {
  double cut = 0;
  while (!simulation.finished()) {
    if (cut <= simulation.time()) cut = simulation.time() + 0.0137;
    simulation.step(cut);
    if (each) each(simulation);
  }
}

Numbers positions(const Simulation& simulation) { return simulation.particles().positions; }

class Trajectory : public testing::TestWithParam<Setting> {};

/// A block thrown obliquely, with a crack in the plane, and a rigid body on a path of its own: after every step all are where they must be. At
/// constant acceleration x - v dt/2 is exact. Before, bodies were g t dt/2 too far: 2 mm here.
TEST_P(Trajectory, FallsFreely) {
  const Setting setting = GetParam();
  const bool space = std::get<2>(setting) == 3;
  const auto simulation = make(head(setting, 0.2, 2e-3, space ? "body_force = [0, -10, 0]" : "body_force = [0, -10]") +
                               fmt::format(R"toml(
[[body]]
name = "block"
material = "m"
shape = {{ kind = "{1}", low = [-0.4, -0.2{2}], high = [0.1, 0.1{3}] }}
velocity = [1, 2{0}]
[[rigid]]
name = "tool"
particles_per_cell = 2
shape = {{ kind = "{1}", low = [0.5, -0.4{2}], high = [0.7, -0.2{3}] }}
velocity = [0, {{ expression = "-2*cos(10*t)" }}{0}]
{4}
)toml",
                                           space ? ", 0" : "", space ? "box" : "rectangle", space ? ", -0.1" : "", space ? ", 0.1" : "",
                                           space ? "" : R"([[crack]]
name = "cut"
points = [[-0.3, -0.06], [0.0, -0.03]]
)"));
  const PointFrame start = simulation->particles();
  const CrackFrame crack_start = simulation->cracks();
  double off = 0, tool_off = 0, crack_off = 0;
  run_cut(*simulation, [&](Simulation& s) {
    const double t = s.time();
    const PointFrame now = s.particles();
    const Numbers& body = field(now, "body").values;
    for (std::size_t p = 0; p < body.size(); ++p) {
      const double dx = now.positions[3 * p] - start.positions[3 * p], dy = now.positions[3 * p + 1] - start.positions[3 * p + 1];
      if (body[p] == 0) off = std::fmax(off, std::hypot(dx - t, dy - (2 * t - 5 * t * t)));
      if (body[p] == 1) tool_off = std::fmax(tool_off, std::hypot(dx, dy + 0.2 * std::sin(10 * t)));
    }
    const CrackFrame crack = s.cracks();
    for (const auto* points : {&crack.plane, &crack.upper, &crack.lower}) {
      for (std::size_t v = 0; v < points->size() / 3; ++v) {
        const double dx = (*points)[3 * v] - crack_start.plane[3 * v], dy = (*points)[3 * v + 1] - crack_start.plane[3 * v + 1];
        crack_off = std::fmax(crack_off, std::hypot(dx - t, dy - (2 * t - 5 * t * t)));
      }
    }
  });
  EXPECT_LT(off, 1e-12) << "m: round-off of 100 steps";
  EXPECT_LT(crack_off, 1e-12);
  EXPECT_LT(tool_off, 2e-5) << "m: v dt/2 stands for the path of half a step, a dt^2/8 = 1e-5 m";
}

/// A block under a weight that swings, at three time steps: forces are those of the middle of a step, so the error falls with its square.
TEST_P(Trajectory, FollowsAChangingForce) {
  const Setting setting = GetParam();
  const bool space = std::get<2>(setting) == 3;
  std::vector<double> off;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    const auto simulation =
        make(head(setting, 0.2, step, fmt::format("body_force = [0, {{ expression = \"-10*cos(12*t)\" }}{}]", space ? ", 0" : "")) +
             fmt::format(R"toml(
[[body]]
name = "block"
material = "m"
shape = {{ kind = "{}", low = [-0.4, -0.2{}], high = [0.1, 0.1{}] }}
velocity = [1, 0.5{}]
)toml",
                         space ? "box" : "rectangle", space ? ", -0.1" : "", space ? ", 0.1" : "", space ? ", 0" : ""));
    run_cut(*simulation);
    const double t = 0.2, expected = 0.5 * t - 10. / 144 * (1 - std::cos(12 * t));
    const PointFrame frame = simulation->particles();
    const auto& u = field(frame, "displacement").values;
    off.push_back(0);
    for (std::size_t p = 0; p < u.size() / 3; ++p) off.back() = std::fmax(off.back(), std::hypot(u[3 * p] - t, u[3 * p + 1] - expected));
  }
  EXPECT_LT(off[0], 2e-5) << "m; of a path of 20 cm";
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) EXPECT_GT(off[i] / off[i + 1], 3.5) << "4, but for where steps are cut";
}

/// A disk spins by two radians, at three time steps: places come together with the square of the step. They part by 2e-5 to 8e-5 m between .4 and
/// .2 ms, where v dt/2 = 9e-4 m. Not linear functions, whose forces jump where particles cross cell lines, nor USL, which light nodes make rough at
/// any time step.
class Spin : public testing::TestWithParam<Setting> {};
TEST_P(Spin, PutsTheRimWhereItIs) {
  const Setting setting = GetParam();
  std::string text = R"toml(
[[material]]
name = "stiff"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "disk"
material = "stiff"
shape = { kind = "disk", centre = [0.03, 0.02], radius = 0.45 }
velocity = [{ expression = "1-20*(y-0.02)" }, { expression = "0.5+20*(x-0.03)" }]
)toml";
  const auto places = [&](double step) {
    const auto simulation = make(head(setting, 0.1, step) + text);
    run(*simulation);
    return positions(*simulation);
  };
  const Numbers whole = places(8e-4), half = places(4e-4), quarter = places(2e-4);
  const double first = difference(whole, half), second = difference(half, quarter);
  RecordProperty("apart", fmt::format("{:.2e}", second));
  RecordProperty("ratio", fmt::format("{:.2f}", first / second));
  EXPECT_LT(second, 1e-4) << "m";
  EXPECT_GT(first / second, 2.6)
      << "2.8 (USF, uGIMP) to 4.1; 4 but for cell lines that particles cross in one run and not yet in the other";
}
INSTANTIATE_TEST_SUITE_P(All, Spin,
                         testing::Combine(testing::Values("gimp", "bspline"), testing::Values("usavg", "musl", "usf"), testing::Values(2)),
                         name_of);

/// What is kept for those who look is no part of the state.
TEST(Watching, ChangesNothing) {
  const std::string text = head({"gimp", "usavg", 2}, 0.05, 1e-3) + R"toml(
[[body]]
name = "disk"
material = "m"
shape = { kind = "disk", centre = [0.03, 0.02], radius = 0.45 }
velocity = [{ expression = "1-20*y" }, { expression = "20*x" }]
)toml";
  const auto watched = make(text), unwatched = make(text);
  run(*watched);
  while (!unwatched->finished()) unwatched->step(unwatched->end_time(), {1000, HUGE_VAL});
  EXPECT_EQ(watched->state_hash(), unwatched->state_hash());
  EXPECT_EQ(difference(positions(*watched), positions(*unwatched)), 0) << "m: the last state is always looked at";
}

INSTANTIATE_TEST_SUITE_P(All, Trajectory,
                         testing::Combine(testing::Values("linear", "gimp", "bspline"), testing::Values("usavg", "musl", "usl", "usf"),
                                          testing::Values(2, 3)),
                         name_of);

}  // namespace
}  // namespace crampon::test
