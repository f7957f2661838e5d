/// Waves and vibrations with closed-form answers: validation rows 44 and 46, damping, free flight.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double steel_speed = 5047.5;  // sqrt(200e9/7850), m/s

/// A steel bar of 1.5 m in 2D or 3D, with an initial velocity along it.
std::string steel_bar(bool three_dimensional, const char* shape_functions, const char* velocity, const char* quantity, double far) {
  const auto third = [&](const char* text) { return three_dimensional ? text : ""; };
  return fmt::format(R"toml(
analysis = "{}"
[grid]
origin = [-0.8, 0{}]
size = [1.6, 0.04{}]
cell = 0.01
[time]
end = 1.2e-4
courant = 0.4
[method]
shape_functions = "{}"
[[material]]
name = "steel"
law = "elastic_small_strain"
E = "200 GPa"
nu = 0
density = 7850
[[body]]
name = "bar"
material = "steel"
shape = {{ kind = "{}", low = [-0.75, 0.01{}], high = [0.75, 0.03{}] }}
velocity = [{{ expression = "{}" }}, 0{}]
[[probe]]
name = "near"
quantity = "{}"
point = [0.2525, 0.0225{}]
[[probe]]
name = "far"
quantity = "{}"
point = [{}, 0.0225{}]
)toml",
                     three_dimensional ? "three_dimensional" : "plane_strain", third(", 0"), third(", 0.04"), shape_functions,
                     three_dimensional ? "box" : "rectangle", third(", 0.01"), third(", 0.03"), velocity, third(", 0"), quantity,
                     third(", 0.0225"), quantity, far, third(", 0.0225"));
}

class Bar : public testing::TestWithParam<std::tuple<bool, const char*>> {};

/// Row 44, speed: the halves of a pulse of ten cells run apart at sqrt(E/rho). (Sharper ones are spread by the grid and lag: a front by 3 %.)
TEST_P(Bar, PulseRunsAtTheWaveSpeed) {
  const auto [three_dimensional, shape] = GetParam();
  const auto simulation = make(steel_bar(three_dimensional, shape, "exp(-(x/0.1)^2)", "displacement", 0.5525));
  // Centre of the momentum of the right half; single particles are too noisy to tell.
  const auto centre = [&] {
    const PointFrame frame = simulation->particles();
    const auto& v = field(frame, "velocity").values;
    double sum = 0, momentum = 0;
    for (std::size_t i = 0; i < frame.positions.size(); i += 3) {
      if (frame.positions[i] > 0) sum += v[i] * frame.positions[i], momentum += v[i];
    }
    return sum / momentum;
  };
  double from = 0, t_from = 0;
  run(*simulation, [&](Simulation& s) {
    if (from == 0 && s.time() > 5e-5) from = centre(), t_from = s.time();
  });
  const double lag = 1 - (centre() - from) / (simulation->time() - t_from) / steel_speed;
  RecordProperty("lag_percent", fmt::format("{:.3f}", 100 * lag));
  // By then the halves are 2.5 pulse lengths apart; they run to 0.7 m.
  // The row's tolerance. Mass is lumped over what a node sees, and waves lag the more, the more that is: .40 % (linear), .47 % (quadratic B-spline),
  // .52 % (cubic).
  EXPECT_LT(std::fabs(lag), boxes_of(kind_of_word(shape)).reach_of_sums() < 2 ? 0.005 : 0.0055);
}

/// Row 44, plateau: the halves of the bar run into each other at 1 m/s each; behind the front rho c v = 39.62 MPa.
TEST_P(Bar, ImpactLeavesThePlateauBehind) {
  const auto [three_dimensional, shape] = GetParam();
  const auto simulation = make(steel_bar(three_dimensional, shape, "(x<0)-(x>0)", "stress", 0.1025));
  double mean = 0;
  int count = 0;
  run(*simulation, [&](Simulation& s) {
    // Well behind the front, which passes 0.1 m, and before the echo of the free ends at 1.4 m.
    if (s.time() > 0.25 / steel_speed && s.time() < 0.7 / steel_speed) mean -= value(s, "far.stress_xx"), ++count;
  });
  ASSERT_GT(count, 10);
  EXPECT_NEAR(mean / count, 39.62e6, 0.01 * 39.62e6);
}
INSTANTIATE_TEST_SUITE_P(Bars, Bar, testing::Combine(testing::Bool(), testing::ValuesIn(all_shape_functions())));

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
INSTANTIATE_TEST_SUITE_P(Bars, Vibration, testing::Combine(testing::Values("usf", "usavg"), testing::ValuesIn(all_shape_functions())));

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
