/// A bar of steel-like J2 material is drawn past yield and let back, in plane strain, plane stress and space, with every stress update: force, plastic strain
/// and the balance of energy against the law in closed form.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double E = 1e6, nu = 0.3, Y = 2e3, H = 2e5, rho = 1000;   // Pa, kg/m3
constexpr double cell = 0.01, length = 6 * cell, width = 3 * cell;  // m
constexpr double period = 0.2;    ///< of the pull, s: ten swings of the bar with the stiffness that it has as it flows
constexpr double largest = 2900;  ///< traction at the top, Pa

double traction_at(double t) { return 0.5 * largest * (1 - std::cos(std::numbers::pi * t / period)); }

const char* name_of(StressState state) {
  static const char* const names[] = {"plane_strain", "plane_stress", "three_dimensional"};
  return names[static_cast<int>(state)];
}

std::string bar(StressState state, const char* update, double end) {
  const bool three = state == StressState::three_dimensional;
  std::string text = fmt::format(R"toml(analysis = "{}"
[grid]
origin = [-0.02, -0.02{}]
size = [0.11, 0.08{}]
cell = {}
[time]
end = {}
courant = 0.4
[method]
damping = 100
stress_update = "{}"
shape_functions = "gimp"
[[material]]
name = "steel"
law = "j2_plasticity"
E = {}
nu = {}
yield_stress = {}
hardening_modulus = {}
density = {}
[[body]]
name = "bar"
material = "steel"
shape = {{ kind = "{}", low = [0, 0{}], high = [{}, {}{}] }}
[[load]]
name = "pull"
kind = "traction"
body = "bar"
face = "x+"
value = [{{ expression = "{}*(1-cos(pi*t/{}))" }}, 0{}]
[[probe]]
name = "of_stress"
quantity = "stress"
point = [0.0275, 0.0125{}]
[[probe]]
name = "of_flow"
quantity = "plastic_strain"
point = [0.0275, 0.0125{}]
)toml",
                                 name_of(state), three ? ", -0.02" : "", three ? ", 0.08" : "", cell, end, update, E, nu, Y, H, rho,
                                 three ? "box" : "rectangle", three ? ", 0" : "", length, width, three ? fmt::format(", {}", width) : "",
                                 0.5 * largest, period, three ? ", 0" : "", three ? ", 0.0125" : "", three ? ", 0.0125" : "");
  for (const char* axis : {"x", "y", "z"}) {
    if (axis[0] == 'z' && !three) continue;
    text += fmt::format("[[symmetry]]\nname = \"mirror_{0}\"\naxis = \"{0}\"\nat = 0\nside = \"above\"\n", axis);
  }
  return text;
}

/// Uniform tension along x, the sides free or, along z in plane strain, held.
struct Tension {
  double strain = 0;   ///< logarithmic, along x
  double stress = 0;   ///< Kirchhoff, along x, Pa
  double across = 0;   ///< along z, where plane strain holds it, Pa
  double plastic = 0;  ///< equivalent
  double taken = 0;    ///< J/m3
  double volume = 0;   ///< logarithm of J

  /// tau = F P^T: per area at the start.
  double traction() const { return stress * std::exp(-strain); }
};

/// The rates of both stresses and of the flow, in small steps of strain, until the traction is reached: de = (da - nu db)/E + d n_a and, in plane strain,
/// 0 = (db - nu da)/E + d n_b, else db = 0; n_a da + n_b db = H d, where n = dq/d(a, b) and q^2 = a^2 - a b + b^2.
Tension pull_to(StressState state, double traction) {
  const bool held = state == StressState::plane_strain;
  const double stiff = held ? E / (1 - nu * nu) : E, de = 1e-7;
  Tension now;
  while (now.traction() < traction) {
    double& a = now.stress;
    double& b = now.across;
    const double q = std::sqrt(a * a - a * b + b * b);
    double da = stiff * de, db = held ? nu * stiff * de : 0, d = 0;
    if (q >= Y + H * now.plastic) {
      const double n_a = (2 * a - b) / (2 * q), n_b = held ? (2 * b - a) / (2 * q) : 0;
      const double c_a = stiff * (n_a + (held ? nu * n_b : 0)), c_b = held ? stiff * (n_b + nu * n_a) : 0;
      d = (n_a * da + n_b * db) / (H + n_a * c_a + n_b * c_b);
      da -= d * c_a, db -= d * c_b;
    }
    now.strain += de, a += da, b += db;
    now.taken += d * q, now.plastic += d;
  }
  now.volume = (1 - 2 * nu) / E * (now.stress + now.across);
  return now;
}
/// Elastically back.
Tension let_back(StressState state, Tension now, double traction) {
  const bool held = state == StressState::plane_strain;
  const double stiff = held ? E / (1 - nu * nu) : E, de = 1e-7;
  while (now.traction() > traction) now.strain -= de, now.stress -= stiff * de, now.across -= held ? nu * stiff * de : 0;
  now.volume = (1 - 2 * nu) / E * (now.stress + now.across);
  return now;
}

class DrawnBar : public testing::TestWithParam<std::tuple<StressState, const char*>> {};
std::string name_of_case(const testing::TestParamInfo<std::tuple<StressState, const char*>>& info) {
  return fmt::format("{}_{}", name_of(std::get<0>(info.param)), std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(All, DrawnBar,
                         testing::Combine(testing::Values(StressState::plane_strain, StressState::plane_stress),
                                          testing::Values("usl", "musl", "usf", "usavg")),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Space, DrawnBar, testing::Combine(testing::Values(StressState::three_dimensional), testing::Values("musl")),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(SpaceFull, DrawnBar,
                         testing::Combine(testing::Values(StressState::three_dimensional), testing::Values("usl", "usf", "usavg")),
                         name_of_case);

TEST_P(DrawnBar, YieldsAndUnloadsAsInClosedForm) {
  const auto [state, update] = GetParam();
  const bool three = state == StressState::three_dimensional;
  const double area = width * (three ? width : 1), volume = area * length;
  // Before yield, past it, at the top, and let back by a third, which is elastic. Yielding sets the bar swinging, since it is six times softer from then on;
  // damping of the motion, whose force is .5 % of the yield stress, takes that away. Measured: .9 % of the yield stress and 1.5 % of the plastic strain under way, .3 %
  // and .6 % from the top on.
  const auto simulation = make(bar(state, update, 1.4 * period));
  const Tension top = pull_to(state, largest);
  for (const double t : {0.5 * period, 0.85 * period, period, 1.4 * period}) {
    while (simulation->time() < t * (1 - 1e-12)) simulation->step(t);
    const double traction = traction_at(t);
    const Tension expected = t > period ? let_back(state, top, traction) : pull_to(state, traction);
    const std::string where = fmt::format("at {} s, {} Pa, strain {}", t, traction, expected.strain);
    EXPECT_NEAR(value(*simulation, "of_stress.stress_xx"), expected.stress * std::exp(-expected.volume), 0.01 * Y) << where;
    EXPECT_NEAR(value(*simulation, "of_stress.stress_yy"), 0, 0.01 * Y) << where;
    EXPECT_NEAR(value(*simulation, "of_stress.stress_zz"), expected.across * std::exp(-expected.volume), 0.01 * Y) << where;
    EXPECT_NEAR(value(*simulation, "of_flow.plastic_strain"), expected.plastic, 0.02 * top.plastic) << where;
    EXPECT_NEAR(value(*simulation, "reaction_x.mirror_x"), -traction * area, 0.01 * Y * area) << where;
    EXPECT_NEAR(value(*simulation, "material_loss"), expected.taken * volume, 0.02 * top.taken * volume) << where;
  }
  // What the balance leaves open, over the work of the load. Stress and motion meet at different times of a step: half the strain before and half after the forces
  // with USAVG, which is of second order in time and balances to 1.1e-6 here; all of it before or after with USF and MUSL, of first order in the 2300 steps and more
  // (1.8e-4, of either sign); USL takes the strain from velocities that nodes with little mass make uncertain, and loses what it does not see (1.7e-3).
  const double most = update == std::string("usavg") ? 3e-6 : update == std::string("usl") ? 4e-3 : 4e-4;
  const double work = value(*simulation, "load_work"), open = value(*simulation, "energy_closure");
  EXPECT_LT(std::fabs(open), most * work) << open / work;
  // Without the loss of the material the balance would be open by a good part of the work.
  EXPECT_GT(value(*simulation, "material_loss"), 0.5 * work);
}

}  // namespace
}  // namespace crampon::test
