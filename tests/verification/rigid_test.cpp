/// Rigid bodies and walls: where they are, what they feel, the work they do (validation row 59).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double h = 0.01;                                     // m, cell
constexpr double wave = 31.6227766;                            // sqrt(1e6/1000), m/s, of the material below in a bar with nu = 0
constexpr double length = 20 * h, period = 4 * length / wave;  // of a bar, fixed at one end

std::string material(double nu) {
  return fmt::format("[[material]]\nname = \"m\"\nlaw = \"elastic_small_strain\"\nE = 1e6\nnu = {}\ndensity = 1000\n", nu);
}

struct Push {
  const char* name;
  const char* shape_functions;
  bool wall;             ///< or a body of particles
  const char* velocity;  ///< of the piston
  double first, second;  ///< mean acceleration over the first and the second period, m/s2
};
void PrintTo(const Push& c, std::ostream* out) { *out << c.name; }
class Piston : public testing::TestWithParam<Push> {};

/// A piston pushes a bar. Its force rings with the waves in the bar; over whole periods of the bar it is m a in the mean.
TEST_P(Piston, FeelsMassTimesAcceleration) {
  const Push& c = GetParam();
  const std::string piston = c.wall ? "[[wall]]\npoint = [0.1, 0]\nnormal = [1, 0]\n"
                                    : "[[rigid]]\nshape = { kind = \"rectangle\", low = [0.06, 0.08], high = [0.1, 0.16] }\n";
  const auto simulation = make(fmt::format(R"(
[grid]
origin = [0, 0]
size = [0.5, 0.24]
cell = {}
[time]
end = {}
courant = 0.3
[method]
shape_functions = "{}"
[[body]]
name = "bar"
material = "m"
shape = {{ kind = "rectangle", low = [0.1, 0.1], high = [0.3, 0.14] }}
{}{}name = "piston"
velocity = [{}, 0]
)",
                                           h, 2 * period, c.shape_functions, material(0), piston, c.velocity));
  const double mass = length * 0.04 * 1000;
  double impulse[2] = {}, time[2] = {}, before = 0, momentum_error = 0;
  run(*simulation, [&](Simulation& s) {
    const int half = s.time() > 1.0001 * period;
    impulse[half] += value(s, "reaction_x.piston") * (s.time() - before);
    time[half] += s.time() - before;
    before = s.time();
    momentum_error = std::fmax(momentum_error, std::fabs(impulse[0] + impulse[1] - value(s, "momentum_x")));
  });
  const double first = impulse[0] / time[0] / mass, second = impulse[1] / time[1] / mass;
  EXPECT_NEAR(first, c.first, 0.01 * c.first);     // row 59
  EXPECT_NEAR(second, c.second, 0.01 * c.second);  // row 59
  // The piston is all that acts on the bar: round-off of 530 steps.
  EXPECT_LT(momentum_error, 1e-12 * value(*simulation, "momentum_x"));
  // The energy of the bar is the work of the piston, with errors of the second order in the time step.
  EXPECT_NEAR(value(*simulation, "energy_closure"), 0, 2e-3 * value(*simulation, "boundary_work"));
  EXPECT_NEAR(value(*simulation, "boundary_work"), value(*simulation, "total_energy"), 0.01 * value(*simulation, "total_energy"));
  RecordProperty("first_over_exact", fmt::format("{:.5f}", first / c.first));
  RecordProperty("second_over_exact", fmt::format("{:.5f}", second / c.second));
  RecordProperty("closure_over_work", fmt::format("{:.2e}", value(*simulation, "energy_closure") / value(*simulation, "boundary_work")));
}

// Acceleration that rises evenly over the first period and stays; that comes in two steps, half a period apart, which leaves no ringing; and
// that rises all the time. In none does the bar come loose.
const std::string rising = fmt::format("{{ expression = \"if(t < {0}, 5*t^2/{0}, 10*t - 5*{0})\" }}", period);
const std::string steps =
    fmt::format("{{ times = [0, {}, {}], values = [0, {}, {}] }}", period / 2, 3 * period, 2.5 * period, 27.5 * period);
constexpr const char* growing = "{ expression = \"200*t^2\" }";
INSTANTIATE_TEST_SUITE_P(Pushes, Piston,
                         testing::Values(Push{"rising_linear", "linear", false, rising.c_str(), 5, 10},
                                         Push{"rising_gimp", "gimp", false, rising.c_str(), 5, 10},
                                         Push{"rising_bspline", "bspline", false, rising.c_str(), 5, 10},
                                         Push{"rising_linear_wall", "linear", true, rising.c_str(), 5, 10},
                                         Push{"rising_gimp_wall", "gimp", true, rising.c_str(), 5, 10},
                                         Push{"rising_bspline_wall", "bspline", true, rising.c_str(), 5, 10},
                                         Push{"steps_linear", "linear", false, steps.c_str(), 7.5, 10},
                                         Push{"growing_bspline_wall", "bspline", true, growing, 200 * period, 600 * period},
                                         Push{"growing_gimp", "gimp", false, growing, 200 * period, 600 * period},
                                         Push{"growing_linear_wall", "linear", true, growing, 200 * period, 600 * period}),
                         [](const auto& of) { return of.param.name; });

/// A rigid body, particle by particle, against the motion that its velocity and spin say. Simpson's rule is exact for cubics.
TEST(RigidPose, InThePlaneIsExact) {
  const auto simulation = make(fmt::format(R"(
[grid]
origin = [-1, -1]
size = [4, 4]
cell = 0.1
[time]
end = 0.7
step = 0.0033
{}[[body]]
name = "far"
material = "m"
shape = {{ kind = "rectangle", low = [2.5, 2.5], high = [2.6, 2.6] }}
[[rigid]]
name = "tool"
shape = {{ kind = "rectangle", low = [0.2, 0.2], high = [0.6, 0.4] }}
velocity = [{{ expression = "0.3 - 2*t + 4*t^2" }}, {{ expression = "0.1 + t^3" }}]
spin = [{{ expression = "3 + 10*t" }}]
spin_centre = [0.25, 0.31]
)",
                                           material(0.3)));
  run(*simulation);
  const double t = simulation->time(), angle = 3 * t + 5 * t * t, spin = 3 + 10 * t;
  const double cx = 0.25 + 0.3 * t - t * t + 4 * t * t * t / 3, cy = 0.31 + 0.1 * t + t * t * t * t / 4;
  const double vx = 0.3 - 2 * t + 4 * t * t, vy = 0.1 + t * t * t;
  const PointFrame frame = simulation->particles();
  double misplaced = 0, wrong = 0;
  int count = 0;
  for (std::size_t p = 0; p < frame.positions.size() / 3; ++p) {
    if (field(frame, "body").values[p] != 1) continue;
    ++count;
    const double x = frame.positions[3 * p], y = frame.positions[3 * p + 1];
    const double X = x - field(frame, "displacement").values[3 * p] - 0.25, Y = y - field(frame, "displacement").values[3 * p + 1] - 0.31;
    const double rx = X * std::cos(angle) - Y * std::sin(angle), ry = X * std::sin(angle) + Y * std::cos(angle);
    misplaced = std::fmax(misplaced, std::hypot(x - cx - rx, y - cy - ry));
    const auto& v = field(frame, "velocity").values;
    wrong = std::fmax(wrong, std::hypot(v[3 * p] - vx + spin * ry, v[3 * p + 1] - vy - spin * rx));
  }
  EXPECT_EQ(count, 32);
  EXPECT_LT(misplaced, 1e-12);  // m, round-off of 213 steps
  EXPECT_LT(wrong, 1e-11);      // m/s, the same at 10 rad/s
  RecordProperty("misplaced_m", fmt::format("{:.1e}", misplaced));
}

TEST(RigidPose, InSpaceIsExact) {
  const auto simulation = make(fmt::format(R"(
analysis = "three_dimensional"
[grid]
origin = [-1, -1, -1]
size = [3, 3, 3]
cell = 0.1
[time]
end = 0.7
step = 0.0033
{}[[body]]
name = "far"
material = "m"
shape = {{ kind = "box", low = [1.5, 1.5, 1.5], high = [1.6, 1.6, 1.6] }}
[[rigid]]
name = "tool"
shape = {{ kind = "box", low = [0.2, 0.2, 0.2], high = [0.6, 0.4, 0.3] }}
velocity = [{{ expression = "0.3 - 2*t + 4*t^2" }}, 0.1, {{ expression = "-t" }}]
spin = [{{ expression = "1 + 4*t" }}, {{ expression = "2 + 8*t" }}, {{ expression = "2 + 8*t" }}]
)",
                                           material(0.3)));
  run(*simulation);
  const double t = simulation->time(), angle = 3 * (t + 2 * t * t), c = std::cos(angle), s = std::sin(angle);
  const Vec<3> axis{1. / 3, 2. / 3, 2. / 3}, start{0.4, 0.3, 0.25};
  const Vec<3> centre = start + Vec<3>{0.3 * t - t * t + 4 * t * t * t / 3, 0.1 * t, -t * t / 2};
  const auto cross = [](const Vec<3>& a, const Vec<3>& b) {
    return Vec<3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const PointFrame frame = simulation->particles();
  double misplaced = 0, wrong = 0;
  for (std::size_t p = 0; p < frame.positions.size() / 3; ++p) {
    if (field(frame, "body").values[p] != 1) continue;
    Vec<3> x, X, v;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = frame.positions[3 * p + k];
      X[k] = x[k] - field(frame, "displacement").values[3 * p + k] - start[k];
      v[k] = field(frame, "velocity").values[3 * p + k];
    }
    const Vec<3> r = X * c + cross(axis, X) * s + axis * (dot(axis, X) * (1 - c));  // Rodrigues
    misplaced = std::fmax(misplaced, norm(x - centre - r));
    wrong = std::fmax(wrong, norm(v - Vec<3>{0.3 - 2 * t + 4 * t * t, 0.1, -t} - cross(axis * (3 + 12 * t), r)));
  }
  EXPECT_LT(misplaced, 1e-12);  // m, round-off of 213 steps
  EXPECT_LT(wrong, 1e-11);      // m/s, the same at 11 rad/s
  RecordProperty("misplaced_m", fmt::format("{:.1e}", misplaced));
}

/// A rigid body that prescribes velocities is a [[boundary]] of the nodes that its particles reach.
TEST(RigidBoundary, IsABoundaryOfItsNodes) {
  const std::string rest = fmt::format(R"(
[grid]
origin = [0, 0]
size = [0.5, 0.24]
cell = {}
[time]
end = 0.02
courant = 0.3
{}[[body]]
name = "bar"
material = "m"
shape = {{ kind = "rectangle", low = [0.1, 0.1], high = [0.3, 0.14] }}
)",
                                       h, material(0.3));
  // Moves to and fro by .2 mm, so that its particles, 2.5 mm from the next cell, stay where they are.
  const char* sway = "{ expression = \"0.1*sin(1000*t)\" }";
  for (const char* components : {"", "components = [\"x\"]\n"}) {
    const auto body =
        make(fmt::format("{}[[rigid]]\nname = \"grip\"\nrole = \"boundary\"\n{}velocity = [{}, 0]\n"
                         "shape = {{ kind = \"rectangle\", low = [0.06, 0.08], high = [0.12, 0.16] }}\n",
                         rest, components, sway));
    const auto boundary =
        make(fmt::format("{}[[boundary]]\nname = \"grip\"\nvx = {}\n{}"
                         "region = {{ kind = \"rectangle\", low = [0.06, 0.08], high = [0.12, 0.16] }}\n",
                         rest, sway, *components ? "" : "vy = 0\n"));
    double force = 0, apart = 0;
    while (!boundary->finished()) {
      body->step(HUGE_VAL);
      boundary->step(HUGE_VAL);
      force = std::fmax(force, std::fabs(value(*boundary, "reaction_x.grip")));
      for (const char* column : {"reaction_x.grip", "reaction_y.grip"})
        apart = std::fmax(apart, std::fabs(value(*body, column) - value(*boundary, column)));
    }
    EXPECT_GT(force, 0);
    EXPECT_LT(apart, 1e-12 * force);
    EXPECT_NEAR(value(*body, "boundary_work"), value(*boundary, "boundary_work"), 1e-12 * value(*boundary, "total_energy"));
    const PointFrame all = body->particles(), expected = boundary->particles();
    const std::size_t count = expected.positions.size() / 3;  // those of the bar come first
    for (const char* name : {"velocity", "stress"}) {
      std::vector<double> a = field(all, name).values.doubles();
      const auto& b = field(expected, name).values;
      a.resize(b.size());
      EXPECT_LT(difference(a, b), 1e-12 * largest(b)) << name;
    }
    EXPECT_GT(count, 0u);
  }
}

struct Carrier {
  const char* name;
  const char* shape_functions;
  const char* walls;
  double floor[2];  ///< force of the wall called floor over the weight
};
void PrintTo(const Carrier& c, std::ostream* out) { *out << c.name << ", " << c.shape_functions; }
class RigidSupport : public testing::TestWithParam<Carrier> {};

/// A disk at rest on walls: each carries its part of the weight (row 59: the indenter's reaction is the load).
TEST_P(RigidSupport, CarriesTheWeight) {
  const Carrier& c = GetParam();
  const auto simulation = make(fmt::format(R"(
[grid]
origin = [0, 0]
size = [0.4, 0.4]
cell = {}
[time]
end = 0.3
courant = 0.4
[method]
shape_functions = "{}"
damping = 150
body_force = [0, {{ times = [0, 0.1], values = [0, -10] }}]
{}[[body]]
name = "disk"
material = "m"
shape = {{ kind = "disk", centre = [0.2, 0.2], radius = 0.1 }}
{})",
                                           h, c.shape_functions, material(0.3), c.walls));
  run(*simulation);
  double mass = 0;
  const PointFrame frame = simulation->particles({"mass"});
  for (std::size_t p = 0; p < frame.positions.size() / 3; ++p)
    mass += field(frame, "body").values[p] == 0 ? field(frame, "mass").values[p] : 0;
  const double weight = 10 * mass;
  // 0.3 % of the weight for a disk at rest.
  EXPECT_NEAR(value(*simulation, "reaction_x.floor"), c.floor[0] * weight, 0.003 * weight);
  EXPECT_NEAR(value(*simulation, "reaction_y.floor"), c.floor[1] * weight, 0.003 * weight);
  RecordProperty("reaction_x_over_weight", fmt::format("{:.5f}", value(*simulation, "reaction_x.floor") / weight));
  RecordProperty("reaction_y_over_weight", fmt::format("{:.5f}", value(*simulation, "reaction_y.floor") / weight));
}
constexpr const char* level = "[[wall]]\nname = \"floor\"\npoint = [0, 0.1]\nnormal = [0, 1]\n";
constexpr const char* solid = "[[rigid]]\nname = \"floor\"\nshape = { kind = \"rectangle\", low = [0.05, 0.05], high = [0.35, 0.1] }\n";
constexpr const char* bowl = "[[wall]]\nname = \"floor\"\nkind = \"hollow_ball\"\ncentre = [0.2, 0.25]\nradius = 0.15\n";
// Two planes at 45 degrees that touch the disk: each carries the weight over sqrt 2.
const std::string groove = fmt::format(
    "[[wall]]\nname = \"floor\"\npoint = [0.2, {0}]\nnormal = [1, 1]\n[[wall]]\nname = \"other\"\n"
    "point = [0.2, {0}]\nnormal = [-1, 1]\n",
    0.2 - 0.1 * std::numbers::sqrt2);
INSTANTIATE_TEST_SUITE_P(Disks, RigidSupport,
                         testing::Values(Carrier{"level", "linear", level, {0, 1}}, Carrier{"level", "bspline", level, {0, 1}},
                                         Carrier{"solid", "linear", solid, {0, 1}}, Carrier{"bowl", "gimp", bowl, {0, 1}},
                                         Carrier{"groove", "linear", groove.c_str(), {0.5, 0.5}},
                                         Carrier{"groove", "gimp", groove.c_str(), {0.5, 0.5}}),
                         [](const auto& of) { return fmt::format("{}_{}", of.param.name, of.param.shape_functions); });

/// A drum turns under a block that is pressed on it and held: friction is mu N, its torque the radius times that, and its power all lost.
TEST(Drum, TurnsAgainstFriction) {
  constexpr double radius = 0.2, spin = 2, friction = 0.3;
  const auto simulation = make(fmt::format(R"(
[grid]
origin = [-0.1, 0.1]
size = [0.2, 0.2]
cell = {}
[time]
end = 0.15
courant = 0.3
[method]
shape_functions = "gimp"
damping = 150
[contact]
default = {{ law = "coulomb", friction = {} }}
{}[[body]]
name = "block"
material = "m"
shape = {{ kind = "rectangle", low = [-0.05, 0.2], high = [0.05, 0.28] }}
[[boundary]]
name = "grip"
region = {{ kind = "line", from = [-0.1, 0.28], to = [0.1, 0.28] }}
vx = 0
vy = {{ times = [0, 0.04, 0.05], values = [-0.03, -0.03, 0] }}
[[wall]]
name = "drum"
kind = "ball"
centre = [0, 0]
radius = {}
spin = [{}]
)",
                                           h, friction, material(0.3), radius, spin));
  double y = 0, torque = 0, work = 0, loss = 0, before = 0;
  run(*simulation, [&](Simulation& s) {
    const double dt = s.time() - before;
    before = s.time();
    if (s.time() < 0.1) {
      loss = value(s, "friction_loss");
      return;
    }
    y += value(s, "reaction_y.drum") * dt;
    torque += value(s, "torque_z.drum") * dt;
    work += value(s, "torque_z.drum") * spin * dt;
  });
  loss = value(*simulation, "friction_loss") - loss;
  // The pressure of the drum points through its centre, so the torque is friction's alone, up to the lean of normals over the width of
  // contact, some .05 of the radius.
  EXPECT_GT(y, 0);
  EXPECT_NEAR(torque / (friction * radius * y), 1, 0.005);
  EXPECT_NEAR(loss / work, 1, 0.005);
  RecordProperty("torque_over_exact", fmt::format("{:.4f}", torque / (friction * radius * y)));
  RecordProperty("loss_over_work", fmt::format("{:.4f}", loss / work));
}

}  // namespace
}  // namespace crampon::test
