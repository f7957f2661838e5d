/// Bodies that bear stress from the start ([[body]] initial_stress).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

struct Ground {
  const char* law;
  const char* shape_functions;
  int dimension;
  double offset;          ///< of the surface from a grid line, cells
  double kinetic_energy;  ///< most, J
};
void PrintTo(const Ground& c, std::ostream* out) { *out << c.law << ' ' << c.shape_functions << ' ' << c.dimension << "D " << c.offset; }
class GroundAtRest : public testing::TestWithParam<Ground> {};

std::string ground(const Ground& c, const std::string& stress) {
  const bool space = c.dimension == 3;
  const double height = 1 + 0.1 * c.offset;
  std::string text = fmt::format(R"(
analysis = "{}"
[grid]
origin = {}
size = {}
cell = 0.1
[time]
steps = 100
[method]
shape_functions = "{}"
body_force = {}
[[material]]
name = "m"
law = "{}"
E = 1e6
nu = 0.25
density = 1000
[[body]]
name = "ground"
material = "m"
shape = {{ kind = "{}", low = {}, high = {} }}
particles_per_cell = 4
{}
)",
                                 space ? "three_dimensional" : "plane_strain", space ? "[-0.5, -0.5, -0.5]" : "[-0.5, -0.5]",
                                 space ? "[1.5, 1.5, 2.5]" : "[1.5, 2.5]", c.shape_functions, space ? "[0, 0, -9.81]" : "[0, -9.81]", c.law,
                                 space ? "box" : "rectangle", space ? "[0, 0, 0]" : "[0, 0]",
                                 space ? fmt::format("[0.5, 0.5, {}]", height) : fmt::format("[0.5, {}]", height), stress);
  for (int k = 0; k < c.dimension; ++k) {
    text += fmt::format("[[symmetry]]\nname = \"low{0}\"\naxis = \"{0}\"\nat = 0\n", "xyz"[k]);
    if (k + 1 < c.dimension)
      text += fmt::format("[[symmetry]]\nname = \"high{0}\"\naxis = \"{0}\"\nat = 0.5\nside = \"below\"\n", "xyz"[k]);
  }
  return text;
}

/// Ground that bears its own weight between smooth walls stays where it is. Its stress is linear, which linear functions and uGIMP balance
/// to round-off wherever the surface lies between two rows of particles; for B-splines particles are points, and their sum at the surface
/// differs from the integral: what moves is compared with the 7 J that the ground would gain if the weight came on at once.
TEST_P(GroundAtRest, StaysAtRest) {
  const Ground& c = GetParam();
  const std::string surface = c.dimension == 3 ? fmt::format("[0, 0, {}]", 1 + 0.1 * c.offset) : fmt::format("[0, {}]", 1 + 0.1 * c.offset);
  const auto simulation =
      make(ground(c, fmt::format("initial_stress = {{ kind = \"gravity\", surface = {}, lateral = 0.3333333333333333 }}", surface)));
  double most = 0;
  run(*simulation, [&](Simulation& s) { most = std::fmax(most, value(s, "kinetic_energy")); });
  EXPECT_LT(most, c.kinetic_energy);
  EXPECT_NEAR(value(*simulation, "energy_closure"), 0, 1e-9 + c.kinetic_energy);
}

constexpr double still = 1e-20;  // J: speeds of 1e-12 m/s, round-off of 10 kPa over 1000 kg/m3
INSTANTIATE_TEST_SUITE_P(
    InitialStress, GroundAtRest,
    testing::Values(Ground{"elastic_small_strain", "linear", 2, 0, still}, Ground{"elastic_small_strain", "gimp", 2, 0, still},
                    Ground{"elastic_large_rotation", "gimp", 2, 0.25, still}, Ground{"neo_hookean", "gimp", 2, 0.5, still},
                    Ground{"neo_hookean", "linear", 2, 0.75, still}, Ground{"elastic_small_strain", "bspline", 2, 0, 2e-3},
                    Ground{"neo_hookean", "bspline", 2, 0.25, 2e-3}, Ground{"elastic_large_rotation", "linear", 3, 0.5, still}));
INSTANTIATE_TEST_SUITE_P(InitialStressFull, GroundAtRest, testing::Values(Ground{"neo_hookean", "gimp", 3, 0, still}));

/// Stress by components, here by an expression: probes read it back at the start, and energy is that of the strain behind it.
TEST(InitialStress, ByComponentsIsReadBack) {
  const Ground c{"elastic_small_strain", "linear", 2, 0, 0};
  const auto simulation =
      make(ground(c,
                  "initial_stress = { kind = \"components\", xx = 500, yy = { expression = \"1000*(1-y)\", unit = \"Pa\" }, "
                  "xy = \"0.2 kPa\" }") +
           "[[probe]]\nname = \"p\"\nquantity = \"stress_yy\"\npoint = [0.2375, 0.4125]\n[[probe]]\nname = \"q\"\nquantity = "
           "\"stress_xy\"\npoint = [0.2375, 0.4125]\n");
  EXPECT_NEAR(value(*simulation, "p.stress_yy"), 587.5, 1e-9);  // the probe stands on a particle
  EXPECT_NEAR(value(*simulation, "q.stress_xy"), 200, 1e-9);
  // Plane strain: W = ((1 - nu^2)(sx^2 + sy^2) - 2 nu (1 + nu) sx sy)/(2 E) + (1 + nu) s_xy^2/E; over 0 < y < 1 in rows of particles.
  double energy = 0;
  const double E = 1e6, nu = 0.25, sx = 500, s_xy = 200;
  for (int row = 0; row < 40; ++row) {
    const double sy = 1000 * (1 - (row + 0.5) / 40);
    energy += ((1 - nu * nu) * (sx * sx + sy * sy) - 2 * nu * (1 + nu) * sx * sy) / (2 * E) + (1 + nu) * s_xy * s_xy / E;
  }
  EXPECT_NEAR(value(*simulation, "strain_energy"), energy / 40 * 0.5, 1e-12);
}

TEST(InitialStress, TellsWhatIsWrong) {
  const auto message = [](const std::string& stress, const std::string& more = "") {
    try {
      make(ground({"elastic_small_strain", "linear", 2, 0, 0}, stress), more.empty() ? std::vector<std::string>{} : std::vector{more});
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(message("initial_stress = { kind = \"components\", zz = 1 }").find("body[0].initial_stress: the component zz"),
            std::string::npos);
  EXPECT_NE(message("initial_stress = { kind = \"components\", xx = { expression = \"t\", unit = \"Pa\" } }").find("depends on the time"),
            std::string::npos);
  EXPECT_NE(message("initial_stress = { kind = \"gravity\", surface = [0, 1], lateral = 1 }", "method.body_force=[0, 0]").find("no weight"),
            std::string::npos);
}

}  // namespace
}  // namespace crampon::test
