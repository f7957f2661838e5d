/// Waves and vibrations with closed-form answers: validation rows 44 and 46, damping, free flight.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double steel_speed = 5047.5;  // sqrt(200e9/7850), m/s

/// Two steel bars of 0.75 m run into each other at 1 m/s each.
std::string colliding_bars(bool three_dimensional, const char* shape_functions) {
  const char* third = three_dimensional ? ", 0.04" : "";
  const char* low = three_dimensional ? ", 0.01" : "";
  const char* high = three_dimensional ? ", 0.03" : "";
  const auto body = [&](const char* name, double from, double to, double v) {
    return fmt::format("[[body]]\nname = \"{}\"\nmaterial = \"steel\"\nshape = {{ kind = \"{}\", low = [{}, 0.01{}], high = [{}, 0.03{}] }}\nvelocity = [{}, 0{}]\n",
                       name, three_dimensional ? "box" : "rectangle", from, low, to, high, v, three_dimensional ? ", 0" : "");
  };
  return fmt::format(R"(
analysis = "{}"
[grid]
origin = [-0.8, 0{}]
size = [1.6, 0.04{}]
cell = 0.01
[time]
end = 1.4e-4
courant = 0.4
[method]
shape_functions = "{}"
[[material]]
name = "steel"
law = "elastic_small_strain"
E = "200 GPa"
nu = 0
density = 7850
)",
                     three_dimensional ? "three_dimensional" : "plane_strain", three_dimensional ? ", 0" : "", third, shape_functions) +
         body("left", -0.75, 0, 1) + body("right", 0, 0.75, -1) +
         "[[probe]]\nname = \"near\"\nquantity = \"stress\"\npoint = [-0.1, 0.02" + (three_dimensional ? ", 0.02" : "") + "]\n" +
         "[[probe]]\nname = \"far\"\nquantity = \"stress\"\npoint = [-0.4, 0.02" + (three_dimensional ? ", 0.02" : "") + "]\n";
}

class Impact : public testing::TestWithParam<std::tuple<bool, const char*>> {};

/// Row 44: the front runs at sqrt(E/rho) and carries rho c v = 39.62 MPa per m/s.
TEST_P(Impact, FrontAndPlateauOfTwoBars) {
  const auto [three_dimensional, shape] = GetParam();
  const auto simulation = make(colliding_bars(three_dimensional, shape));
  std::vector<double> t, near, far;
  run(*simulation, [&](Simulation& s) {
    t.push_back(s.time());
    near.push_back(-value(s, "near.stress_xx"));
    far.push_back(-value(s, "far.stress_xx"));
  });
  const double plateau = 39.62e6;
  // A lumped-mass grid disperses the front into an Airy function's integral, which is 1/3 at x = c t.
  const double level = plateau / 3;
  const auto arrival = [&](const std::vector<double>& s) {
    std::size_t i = 1;
    while (i + 1 < s.size() && s[i] < level) ++i;
    return t[i - 1] + (level - s[i - 1]) / (s[i] - s[i - 1]) * (t[i] - t[i - 1]);
  };
  EXPECT_NEAR(0.3 / (arrival(far) - arrival(near)), steel_speed, 0.005 * steel_speed);  // the row's tolerance
  double mean = 0;
  int count = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] > 0.25 / steel_speed && t[i] < 0.6 / steel_speed) mean += near[i], ++count;
  }
  EXPECT_NEAR(mean / count, plateau, 0.01 * plateau);
}
INSTANTIATE_TEST_SUITE_P(Bars, Impact, testing::Combine(testing::Bool(), testing::Values("linear", "gimp", "bspline")));

/// Row 46: fixed at the left by a wall, free at the right, v = v0 sin(pi x / 2L): omega = pi c / 2L.
class Vibration : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(Vibration, FrequencyAndEnergyOfABar) {
  const auto [update, shape] = GetParam();
  const double L = 1, c = 100, omega = M_PI * c / (2 * L), period = 2 * M_PI / omega;
  const auto simulation = make(fmt::format(R"toml(
[grid]
origin = [-0.1, 0]
size = [1.2, 0.1]
cell = 0.025
[time]
end = {}
courant = 0.2  # USF knows strain half a step off: its energy swings by omega dt/2, 0.4 % here
[method]
stress_update = "{}"
shape_functions = "{}"
[[material]]
name = "m"
law = "elastic_small_strain"
E = 1e7
nu = 0
density = 1000
[[body]]
name = "bar"
material = "m"
shape = {{ kind = "rectangle", low = [0, 0.025], high = [1, 0.075] }}
velocity = [{{ expression = "0.01*sin(pi*x/2)" }}, 0]
[[symmetry]]
name = "wall"
axis = "x"
at = 0
[[probe]]
name = "tip"
quantity = "velocity"
point = [1, 0.05]
)toml",
                                          5 * period, update, shape));
  const double energy = value(*simulation, "total_energy");
  double low = energy, high = energy, last_t = 0, last_v = value(*simulation, "tip.velocity_x");
  std::vector<double> zeros;
  run(*simulation, [&](Simulation& s) {
    const double e = value(s, "total_energy"), v = value(s, "tip.velocity_x");
    low = std::fmin(low, e);
    high = std::fmax(high, e);
    if ((v > 0) != (last_v > 0)) zeros.push_back(last_t + (s.time() - last_t) * last_v / (last_v - v));
    last_t = s.time();
    last_v = v;
  });
  ASSERT_GE(zeros.size(), 9u);
  const double measured = M_PI * static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
  EXPECT_NEAR(measured, omega, 0.005 * omega);
  EXPECT_GT(low, 0.995 * energy);
  EXPECT_LT(high, 1.005 * energy);
}
INSTANTIATE_TEST_SUITE_P(Bars, Vibration, testing::Combine(testing::Values("usf", "usavg"), testing::Values("linear", "gimp", "bspline")));

const char* flying_block = R"(
[grid]
origin = [0, 0]
size = [2, 2]
cell = 0.0625
[time]
steps = 100
step = 1e-3
[method]
damping = {}
[[material]]
name = "m"
law = "elastic_small_strain"
E = 1e5
nu = 0.3
density = 1000
[[body]]
name = "block"
material = "m"
shape = {{ kind = "rectangle", low = [0.5, 0.5], high = [1, 0.875] }}
velocity = [2, 1]
)";

/// f = -kappa p on every node slows a body in free flight by (1 - kappa dt) a step, exactly.
TEST(Damping, SlowsFreeFlightGeometrically) {
  const auto simulation = make(fmt::format(fmt::runtime(flying_block), 7));
  const double start = value(*simulation, "momentum_x");
  run(*simulation);
  EXPECT_NEAR(value(*simulation, "momentum_x"), start * std::pow(1 - 7e-3, 100), 1e-12 * start);  // round-off of 100 products
  const double lost = value(*simulation, "damping_loss"), kinetic = value(*simulation, "kinetic_energy");
  EXPECT_NEAR(lost + kinetic, 0.5 * 187.5 * 5, 1e-10 * 468.75);  // what is lost is booked: mass 187.5 kg, 5 m2/s2
}

TEST(FreeFlight, StressesNothing) {
  const auto simulation = make(fmt::format(fmt::runtime(flying_block), 0));
  run(*simulation);
  EXPECT_LT(largest(field(simulation->particles(), "stress").values), 1e-12 * 1e5);  // round-off against E
  EXPECT_NEAR(value(*simulation, "total_energy"), 468.75, 1e-12 * 468.75);
}

}  // namespace
}  // namespace crampon::test
