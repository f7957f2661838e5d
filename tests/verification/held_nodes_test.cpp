/// The three rules for the force on nodes of prescribed velocity (method.fixed_force): what each does to energy and momentum.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double c = 100, rho = 1000;  // m/s: speed of waves along the bar; kg/m3

/// A bar along x, or a beam, of 1 m in 40 cells: its size across in cells, with the velocity at the start and the conditions.
std::string bar(const char* rule, double courant, double end, int across, const std::string& velocity, const std::string& conditions) {
  const double h = 0.025;
  return fmt::format(R"in(
analysis = "plane_stress"
[grid]
origin = [-0.2, -0.1]
size = [1.4, {}]
cell = {}
[time]
end = {}
courant = {}
[method]
fixed_force = "{}"
[[material]]
name = "m"
law = "elastic_small_strain"
E = {}
nu = 0
density = {}
[[body]]
name = "bar"
material = "m"
shape = {{ kind = "rectangle", low = [0, 0], high = [1, {}] }}
{}
{})in",
                     0.2 + across * h, h, end, courant, rule, rho * c * c, rho, across * h, velocity, conditions);
}

struct Held {
  const char* rule;
  double courant;
  double energy_within, momentum_within, speed_within;
};
void PrintTo(const Held& held, std::ostream* out) { *out << held.rule << ", Courant number " << held.courant; }

class HeldNodes : public testing::TestWithParam<Held> {
 protected:
  /// Walls that stand still do no work.
  void expect_energy_kept(const std::string& input) {
    const auto simulation = make(input);
    const double energy = value(*simulation, "total_energy");
    run(*simulation);
    const double kept = value(*simulation, "total_energy") / energy;
    RecordProperty("kept", fmt::format("{:.5f}", kept));
    EXPECT_LE(kept, 1 + 1e-4);
    EXPECT_GE(kept, 1 - GetParam().energy_within);
    EXPECT_EQ(value(*simulation, "boundary_work"), 0);
  }
};

/// Held at one end, v = v_0 sin(pi x/2L): five periods.
TEST_P(HeldNodes, VibratingBar) {
  const Held& held = GetParam();
  expect_energy_kept(bar(held.rule, held.courant, 5 * 4 / c, 4, "velocity = [{ expression = \"0.01*sin(pi*x/2)\" }, 0]",
                         "[[boundary]]\nname = \"wall\"\nregion = { kind = \"line\", from = [0, -0.1], to = [0, 0.3] }\nvx = 0\n"));
}

/// Four by forty cells, thrown up as half a sine: three periods of the first mode.
TEST_P(HeldNodes, BeamOnSupports) {
  const Held& held = GetParam();
  const double depth = 0.1, omega = M_PI * M_PI * c * depth / std::sqrt(12.);
  expect_energy_kept(bar(held.rule, held.courant, 3 * 2 * M_PI / omega, 4, "velocity = [0, { expression = \"0.01*sin(pi*x)\" }]",
                         "[[boundary]]\nname = \"left\"\nregion = { kind = \"point\", at = [0, 0] }\nvy = 0\n"
                         "[[boundary]]\nname = \"right\"\nregion = { kind = \"point\", at = [1, 0] }\nvy = 0\n"));
}

/// A wall starts at once with 0.01 m/s against a bar at rest: rho c v A t of momentum, the same speed behind the front, and rho c v^2 A t of work.
TEST_P(HeldNodes, WallThatStartsAtOnce) {
  const double v = 0.01, t = 0.7 / c;
  const auto simulation =
      make(bar(GetParam().rule, GetParam().courant, t, 4, "",
               "[[boundary]]\nname = \"wall\"\nregion = { kind = \"line\", from = [0, -0.1], to = [0, 0.3] }\nvx = 0.01\n"
               "[[probe]]\nname = \"near\"\nquantity = \"velocity\"\npoint = [0.0375, 0.0375]\n"));
  double speed = 0;
  int count = 0;
  run(*simulation, [&](Simulation& s) {
    if (s.time() > t / 2) speed += value(s, "near.velocity_x"), ++count;
  });
  const Held& held = GetParam();
  const double momentum = rho * c * v * 0.1 * t;
  // The wave has passed 28 cells. Incremental forces start half a time step late; N13's swallow 1.5 % of the work done.
  EXPECT_NEAR(value(*simulation, "momentum_x"), momentum, held.momentum_within * momentum);
  EXPECT_NEAR(value(*simulation, "boundary_work"), momentum * v, held.momentum_within * momentum * v);
  EXPECT_NEAR(speed / count, v, held.speed_within * v);
  EXPECT_NEAR(value(*simulation, "energy_closure"), 0, 0.02 * momentum * v);
  RecordProperty("momentum", fmt::format("{:.5f}", value(*simulation, "momentum_x") / momentum));
  RecordProperty("speed", fmt::format("{:.4f}", speed / count / v));
  RecordProperty("work", fmt::format("{:.4f}", value(*simulation, "boundary_work") / (momentum * v)));
  RecordProperty("energy", fmt::format("{:.4f}", value(*simulation, "total_energy") / (momentum * v)));
  RecordProperty("closure", fmt::format("{:.2e}", value(*simulation, "energy_closure") / (momentum * v)));
}

/// A bar that already moves with the wall feels nothing.
TEST_P(HeldNodes, WallThatMovesWithTheBar) {
  const auto simulation =
      make(bar(GetParam().rule, GetParam().courant, 0.7 / c, 4, "velocity = [0.01, 0]",
               "[[boundary]]\nname = \"wall\"\nregion = { kind = \"line\", from = [0, -0.1], to = [0, 0.3] }\nvx = 0.01\n"));
  double largest_change = 0;
  run(*simulation, [&](Simulation& s) {
    const PointFrame frame = s.particles({"velocity"});
    const auto& v = field(frame, "velocity").values;
    for (std::size_t p = 0; p < v.size(); p += 3) largest_change = std::fmax(largest_change, std::fabs(v[p] - 0.01));
  });
  EXPECT_LT(largest_change, 1e-12 * 0.01);
}

std::vector<Held> rules() {
  std::vector<Held> list;
  for (const double courant : {0.15, 0.3, 0.6}) {
    list.push_back({"incremental", courant, 5e-4, 0.015, 0.01});
    list.push_back({"n13", courant, 0.01, 0.001, 0.01});
    list.push_back({"zero", courant, 5e-4, 0.015, 0.25});  // the nodes beside a wall that starts get a fifth too much
  }
  return list;
}
INSTANTIATE_TEST_SUITE_P(Rules, HeldNodes, testing::ValuesIn(rules()));

}  // namespace
}  // namespace crampon::test
