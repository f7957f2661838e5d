/// Bodies that come to rest: damping of particles, transfers that take short waves, `[time] stop_at_rest` and the damping that is advised
/// (docs/theory/step.md, transfers; docs/static_solutions.md).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "crampon/run/estimate.hpp"
#include "run_case.hpp"

namespace crampon::test {
namespace {

struct Column {
  int dimension;
  const char* shape_functions;
  std::string method;
  double speed;  ///< m/s, in the mean square, that may be left
};
void PrintTo(const Column& c, std::ostream* out) { *out << c.dimension << "D " << c.shape_functions << ' ' << c.method; }
class ColumnUnderItsWeight : public testing::TestWithParam<Column> {};

/// 1 m high, .3 m wide, on a floor without friction; cells of 0.1 m, c = 33 m/s: the longest wave takes .12 s to and fro.
std::string column(const Column& c, double end) {
  const bool space = c.dimension == 3;
  std::string text =
      fmt::format(R"(
analysis = "{}"
[grid]
origin = {}
size = {}
cell = 0.1
[time]
end = {}
courant = 0.4
[method]
shape_functions = "{}"
body_force = {}
{}
[[material]]
name = "m"
law = "neo_hookean"
E = 1e6
nu = 0.2
density = 1000
[[body]]
name = "bar"
material = "m"
shape = {{ kind = "{}", low = {}, high = {} }}
)",
                  space ? "three_dimensional" : "plane_strain", space ? "[-0.3, -0.3, -0.3]" : "[-0.3, -0.3]",
                  space ? "[0.9, 0.9, 1.8]" : "[0.9, 1.8]", end, c.shape_functions, space ? "[0, 0, -10]" : "[0, -10]", c.method,
                  space ? "box" : "rectangle", space ? "[0, 0, 0]" : "[0, 0]", space ? "[0.3, 0.3, 1]" : "[0.3, 1]");
  for (int k = 0; k < c.dimension; ++k) text += fmt::format("[[symmetry]]\nname = \"plane{}\"\naxis = \"{}\"\nat = 0\n", k, "xyz"[k]);
  return text;
}

/// The column starts to fall at up to .18 m/s and is damped by 100 1/s, near the critical value. After .6 s nothing but short waves is left, which
/// nodes do not see: damping takes them too, and so do transfers. The floor then bears the weight.
TEST_P(ColumnUnderItsWeight, ComesToRest) {
  const Column& c = GetParam();
  const auto simulation = make(column(c, 0.6));
  run(*simulation);
  const double mass = c.dimension == 2 ? 300 : 90;  // kg
  const double speed = std::sqrt(2 * value(*simulation, "kinetic_energy") / mass);
  RecordProperty("speed", fmt::format("{:.1e}", speed));
  EXPECT_LT(speed, c.speed);
  const std::string floor = fmt::format("reaction_{}.plane{}", "xyz"[c.dimension - 1], c.dimension - 1);
  EXPECT_NEAR(value(*simulation, floor), mass * 10, 1e-3 * mass * 10);
  EXPECT_NEAR(value(*simulation, "energy_closure"), 0, 0.005 * value(*simulation, "strain_energy"));
}

std::vector<Column> columns() {
  std::vector<Column> out;
  for (const int dimension : {2, 3}) {
    for (const char* shape_functions : {"gimp", "bspline"}) {
      for (const char* damping : {"damping = 100", "particle_damping = 100"}) out.push_back({dimension, shape_functions, damping, 5e-4});
      for (const char* transfer : {"{ kind = \"flip\", pic = 0.02 }", "{ kind = \"xpic\", order = 2 }", "{ kind = \"fmpm\", order = 2 }",
                                   "{ kind = \"xpic\", order = 2, every = 10 }"}) {
        if (dimension == 3 && std::string(transfer).find("fmpm") == std::string::npos) continue;
        out.push_back({dimension, shape_functions, fmt::format("damping = 100\ntransfer = {}", transfer), 5e-4});
      }
    }
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Rest, ColumnUnderItsWeight, testing::ValuesIn(columns()));

/// N03's damping of nodes alone leaves them.
TEST(DampingOfNodes, LeavesShortWaves) {
  const auto simulation = make(column({2, "bspline", "damping = 100\npositions = \"n03\"", 0}, 0.6));
  run(*simulation);
  EXPECT_GT(std::sqrt(2 * value(*simulation, "kinetic_energy") / 300), 1e-3);  // m/s
}

/// The run ends by itself, long before its end, and says so.
TEST(StopAtRest, EndsWhenNothingMoves) {
  for (const int dimension : {2, 3}) {
    for (const char* shape_functions : {"gimp", "bspline"}) {
      const auto simulation =
          make(column({dimension, shape_functions, "particle_damping = 100", 0}, 20), {"time.stop_at_rest={ ratio = 1e-5, period = 0.1 }"});
      run(*simulation);
      EXPECT_LT(simulation->time(), 2) << shape_functions;
      EXPECT_LE(value(*simulation, "kinetic_energy"), 1e-5 * value(*simulation, "strain_energy")) << shape_functions;
      ASSERT_EQ(simulation->notes().size(), 1u);
      EXPECT_NE(
          simulation->notes()[0].find("at rest: kinetic energy stayed under 1e-05 of the strain energy for 0.1 s (time.stop_at_rest)"),
          std::string::npos)
          << simulation->notes()[0];
    }
  }
}

/// What swings passes through rest twice in a period and does not end the run.
TEST(StopAtRest, IsNotTakenInByASwing) {
  const auto simulation = make(column({2, "gimp", "", 0}, 0.5), {"time.stop_at_rest={ ratio = 0.2, period = 0.1 }"});
  run(*simulation);
  EXPECT_NEAR(simulation->time(), 0.5, 1e-12);
  EXPECT_TRUE(simulation->notes().empty());
}

/// The slowest swing of a bar held at one end, pi c/(2 L), and of a cantilever, 1.875^2/(L^2) sqrt(E t^2/(12 rho)), as estimated before the run,
/// against those of the run itself: the time between two crossings of the mean.
double measured_frequency(Simulation& simulation, const std::string& column) {
  std::vector<double> t, u;
  run(simulation, [&](Simulation& s) {
    t.push_back(s.time());
    u.push_back(value(s, column));
  });
  double mean = 0;
  for (std::size_t i = 1; i < u.size(); ++i) mean += u[i] * (t[i] - t[i - 1]) / t.back();
  std::vector<double> crossings;
  for (std::size_t i = 1; i < u.size(); ++i) {
    if ((u[i] > mean) != (u[i - 1] > mean)) crossings.push_back(t[i]);
  }
  return std::numbers::pi * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

std::string beam(const char* velocity, double end) {
  return fmt::format(R"(
analysis = "plane_stress"
[grid]
origin = [-0.5, -1]
size = [2, 2]
cell = 0.05
[time]
end = {}
[method]
shape_functions = "gimp"
[[material]]
name = "m"
law = "elastic_large_rotation"
E = 1e6
nu = 0
density = 1000
[[body]]
name = "beam"
material = "m"
shape = {{ kind = "rectangle", low = [0, 0], high = [1, 0.1] }}
velocity = {}
[[boundary]]
name = "held"
region = {{ kind = "rectangle", low = [-0.5, -1], high = [0, 1] }}
vx = 0
vy = 0
[[probe]]
name = "end"
quantity = "displacement"
point = [1, 0.05]
)",
                     end, velocity);
}

TEST(SlowestSwing, IsThatOfTheBeam) {
  const auto swing = estimate_slowest_swing(read_problem_text(beam("[0, 0]", 1), "test.toml", "."));
  ASSERT_TRUE(swing);
  EXPECT_EQ(swing->body, "beam");
  const double theory = 1.8751 * 1.8751 * std::sqrt(1e6 / 1000 / 12) * 0.1;  // 3.21 1/s
  EXPECT_NEAR(swing->bending, theory, 1e-3 * theory);
  EXPECT_NEAR(critical_damping(swing->frequency()), 2 * theory, 2e-3 * theory);
  const auto simulation = make(beam("[0, { expression = \"0.1*x^2\", unit = \"m/s\" }]", 6));
  EXPECT_NEAR(measured_frequency(*simulation, "end.displacement_y"), swing->bending, 0.05 * swing->bending);
}

TEST(SlowestSwing, IsThatOfTheBar) {
  const Column standing{2, "gimp", "", 0};
  const auto swing = estimate_slowest_swing(read_problem_text(column(standing, 1), "test.toml", "."));
  ASSERT_TRUE(swing);
  const double c = std::sqrt(1e6 * 0.8 / (1000 * 1.2 * 0.6));
  EXPECT_NEAR(swing->along, std::numbers::pi * c / 2, 1e-12 * c);
  EXPECT_NEAR(swing->bending, 1.015 * 0.3 * c, 1e-12 * c);
  // Between mirrors on both sides it swings along its length alone.
  const auto simulation = make(column(standing, 1) + "[[symmetry]]\nname = \"right\"\naxis = \"x\"\nat = 0.3\nside = \"below\"\n" +
                               "[[probe]]\nname = \"top\"\nquantity = \"displacement\"\npoint = [0.15, 1]\n");
  EXPECT_NEAR(measured_frequency(*simulation, "top.displacement_y"), swing->along, 0.05 * swing->along);
}

}  // namespace
}  // namespace crampon::test
