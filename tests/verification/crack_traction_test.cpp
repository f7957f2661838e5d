/// Traction laws in the engine: a crack pulled open evenly, sheared, bridged, and under pressure.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "run_case.hpp"

namespace crampon::test {
namespace {

const char* sawtooth = R"in(
law = "triangular"
normal = { strength = "2 MPa", toughness = "100 J/m2", stiffness = "1e12 Pa/m" }
shear = { strength = "1 MPa", toughness = "60 J/m2", stiffness = "1e12 Pa/m" }
)in";

/// Two halves of a stiff strip that are moved apart (vy) or past each other (vx) at the speed v, m/s.
std::string pulled_apart(const std::string& component, double v, double end, const char* shape_functions, const std::string& traction) {
  return fmt::format(R"in(
analysis = "plane_strain"
[grid]
origin = ["-4 mm", "-16 mm"]
size = ["28 mm", "32 mm"]
cell = "2 mm"
[time]
end = {}
courant = 0.4
[method]
shape_functions = "{}"
damping = 20000
[[material]]
name = "stiff"
law = "elastic_small_strain"
E = "10 GPa"
nu = 0
density = "1000 kg/m3"
[[body]]
name = "strip"
material = "stiff"
shape = {{ kind = "rectangle", low = ["0 mm", "-8 mm"], high = ["20 mm", "8 mm"] }}
thickness = "10 mm"
[[crack]]
name = "cohesive"
points = [["-2 mm", "0 mm"], ["22 mm", "0 mm"]]
contact = {{ law = "frictionless" }}
traction_region = {{ kind = "rectangle", low = ["0 mm", "-1 mm"], high = ["20 mm", "1 mm"] }}
[crack.traction]
{}
[[boundary]]
name = "top"
region = {{ kind = "rectangle", low = ["-10 mm", "4 mm"], high = ["30 mm", "16 mm"] }}
{} = {}
[[boundary]]
name = "bottom"
region = {{ kind = "rectangle", low = ["-10 mm", "-16 mm"], high = ["30 mm", "-4 mm"] }}
{} = {}
)in",
                     end, shape_functions, traction, component, v, component, -v);
}

struct Mode {
  const char* component;
  const char* shape_functions;
};
void PrintTo(const Mode& m, std::ostream* out) { *out << m.component << ", " << m.shape_functions; }
class CohesiveCrack : public testing::TestWithParam<Mode> {};

/// Force and energy of a crack of 20 x 10 mm that fails everywhere at once.
TEST_P(CohesiveCrack, FailsAtItsStrengthAndTakesItsToughness) {
  const bool opens = std::string(GetParam().component) == "vy";
  const double area = 0.02 * 0.01, strength = opens ? 2e6 : 1e6, toughness = opens ? 100. : 60.;
  // Slow against the 6 us that a wave takes across a half; the final openings are 0.1 and 0.12 mm.
  const auto simulation = make(pulled_apart(GetParam().component, 0.03, 2.4e-3, GetParam().shape_functions, sawtooth));
  const std::string column = std::string("reaction_") + (opens ? "y" : "x") + ".top";
  double largest_force = 0, worst_closure = 0;
  run(*simulation, [&](Simulation& s) {
    largest_force = std::fmax(largest_force, value(s, column));
    worst_closure = std::fmax(worst_closure, std::fabs(value(s, "energy_closure")));
  });
  const double I = value(*simulation, "cohesive_loss_I"), II = value(*simulation, "cohesive_loss_II");
  RecordProperty("force", fmt::format("{:.4f}", largest_force / (strength * area)));
  RecordProperty("energy", fmt::format("{:.5f}", (opens ? I : II) / (toughness * area)));
  RecordProperty("closure", fmt::format("{:.2e}", worst_closure / (toughness * area)));
  EXPECT_NEAR(largest_force, strength * area, 0.03 * strength * area);  // reached within one step's opening of the peak, and inertia
  EXPECT_NEAR(opens ? I : II, toughness * area, 0.01 * toughness * area);
  EXPECT_NEAR(opens ? II : I, 0, 1e-3 * toughness * area);
  EXPECT_LT(worst_closure, 0.02 * toughness * area);
  EXPECT_EQ(simulation->event_count(), 21u);  // every vertex
}
std::vector<Mode> modes() {
  return for_all_shape_functions<Mode>([](const char* shape) { return std::vector<Mode>{{"vy", shape}, {"vx", shape}}; });
}
INSTANTIATE_TEST_SUITE_P(Modes, CohesiveCrack, testing::Values(Mode{"vx", "gimp"}));
INSTANTIATE_TEST_SUITE_P(ModesFull, CohesiveCrack, testing::ValuesIn(modes()));

}  // namespace
}  // namespace crampon::test
