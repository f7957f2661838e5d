/// Rigid shapes that turn or bear: a tool about its centre, a hole about what fills it, shapes that have turned, and those that carry a disk.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tool_cases.hpp"

namespace crampon::test {
namespace {

struct Turned {
  const char* shape_functions;
};
void PrintTo(const Turned& c, std::ostream* out) { *out << c.shape_functions; }

struct HoleFigures {
  double torque;    ///< over that of friction
  double pressure;  ///< of the disk in the mean
};

/// A disk under pressure p fills a round hole in a tool, which turns. Friction holds against it on all of the hole: mu p 2 pi R^2. The mean
/// pressure of the disk is that of its rim: the integral of x.t over the rim is -2 p A.
HoleFigures turn_hole(const char* shape_functions, const Plane& shift, As as) {
  constexpr double radius = 8, pressure = 0.02, spin = 0.004, end = 160, sliding = 80;
  const Placement at{0, shift};
  std::string text = text_of({.shape_functions = shape_functions, .reach = 19, .end = end, .damping = 0.3, .law = rubbing(), .nu = 0.3});
  text += body(at, grains_of_disk(0, 0, radius, 0.5),
               fmt::format("initial_stress = {{ kind = \"components\", xx = {0}, yy = {0} }}\n", -pressure));
  text += fmt::format("[[rigid]]\nname = \"axle\"\nrole = \"boundary\"\nshape = {}\n", at.shape(disk(0, 0, 1.2)));
  const std::string motion = fmt::format("spin = [{{ times = [0, 20, 40], values = [0, 0, {}] }}]\n", spin);
  if (as == As::wall)
    text += fmt::format("[[wall]]\nname = \"tool\"\nkind = \"hollow_ball\"\ncentre = {}\nradius = {}\n{}", at.text_of_point(0, 0), radius,
                        motion);
  else
    text += fmt::format(
        "[[rigid]]\nname = \"tool\"\nshape = {}\nspin_centre = {}\n{}",
        at.shape(fmt::format("{{ kind = \"difference\", of = {}, without = [{}] }}", rectangle(-11, -11, 11, 11), disk(0, 0, radius))),
        at.text_of_point(0, 0), motion);
  const auto simulation = make(text);
  double torque = 0, push = 0, time = 0, before = 0;
  run(*simulation, [&](Simulation& s) {
    const double dt = s.time() - before;
    before = s.time();
    if (s.time() < sliding) return;
    const PointFrame frame = s.particles({"stress", "volume"});
    const auto &stress = field(frame, "stress").values, &volume = field(frame, "volume").values;
    for (std::size_t p = 0; p < volume.size(); ++p) {
      if (field(frame, "body").values[p] != 0) continue;
      push -= volume[p] * (stress[6 * p] + stress[6 * p + 1]) * dt;  // the integral of p R over the rim
    }
    torque += value(s, "torque_z.tool") * dt;
    time += dt;
  });
  return {torque / (friction * push), push / time / (2 * std::numbers::pi * radius * radius)};
}

class TurningHole : public testing::TestWithParam<Turned> {};
void expect_rubbing_all_round(const Turned& c) {
  double worst = 0, worst_of_wall = 0, pressure = 0;
  for (const Plane& shift : places(2)) {
    const HoleFigures hole = turn_hole(c.shape_functions, shift, As::shape);
    const HoleFigures wall = turn_hole(c.shape_functions, shift, As::wall);
    EXPECT_NEAR(hole.torque, 1, 0.01) << shift.first << ", " << shift.second;
    EXPECT_NEAR(hole.pressure, wall.pressure, 0.01 * wall.pressure) << shift.first << ", " << shift.second;
    worst = std::fmax(worst, std::fabs(hole.torque - 1));
    worst_of_wall = std::fmax(worst_of_wall, std::fabs(wall.torque - 1));
    pressure = std::fmax(pressure, std::fabs(hole.pressure / wall.pressure - 1));
  }
  testing::Test::RecordProperty("worst_torque", fmt::format("{:.4f}", worst));
  testing::Test::RecordProperty("worst_torque_of_a_wall", fmt::format("{:.4f}", worst_of_wall));
  testing::Test::RecordProperty("worst_pressure_against_wall", fmt::format("{:.4f}", pressure));
}
TEST_P(TurningHole, RubsAllRound) { expect_rubbing_all_round(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Holes, TurningHole, testing::Values(Turned{"linear"}, Turned{"bspline"}),
                         [](const auto& of) { return std::string(of.param.shape_functions); });

/// Tools with many sides, symmetric about a corner or a side, push a symmetric block without friction: no force to a side. (Where sides turn by more than a
/// quarter, round-off may decide which of two a column sees: B-splines before 24 sides at a radius of 6 cells read .02 to a side.)
TEST(ManySidedTool, PushesStraight) {
  double worst = 0;
  for (const char* shape_functions : all_shape_functions()) {
    for (const auto& [radius, sides] : {std::pair{12., 48}, std::pair{20., 30}, std::pair{40., 96}}) {
      for (const double turned : {0., 0.5}) {
        // The bottom of it, in the order of x, closed above.
        std::string corners;
        double last = 0;
        for (int k = -sides / 2; k < sides / 2; ++k) {
          const double angle = 2 * std::numbers::pi * (k + turned) / sides, y = radius - radius * std::cos(angle);
          if (y > 5 || std::fabs(angle) > std::numbers::pi / 2) continue;
          last = radius * std::sin(angle);
          corners += fmt::format("[{:.17g}, {:.17g}], ", last, y);
        }
        corners += fmt::format("[{:.17g}, 6], [{:.17g}, 6]", last, -last);
        std::string text = text_of({.shape_functions = shape_functions, .reach = 22, .end = 3, .material = "neo_hookean", .nu = 0.3});
        text += fmt::format("[[body]]\nname = \"block\"\nmaterial = \"m\"\nshape = {}\n", rectangle(-5, -5, 5, 0));
        text += "[[wall]]\nname = \"floor\"\npoint = [0, -5]\nnormal = [0, 1]\n";
        text +=
            fmt::format("[[rigid]]\nname = \"tool\"\nshape = {{ kind = \"polygon\", corners = [{}] }}\nvelocity = [0, -0.2]\n", corners);
        const auto simulation = make(text);
        double aside = 0, down = 0;
        run(*simulation, [&](Simulation& s) {
          aside = std::fmax(aside, std::fabs(value(s, "reaction_x.tool")));
          down = std::fmax(down, std::fabs(value(s, "reaction_y.tool")));
        });
        EXPECT_GT(down, 0);
        EXPECT_LT(aside, 1e-9 * down) << shape_functions << ", " << sides << " sides, turned by " << turned;
        worst = std::fmax(worst, aside / down);
      }
    }
  }
  RecordProperty("worst_force_aside", fmt::format("{:.1e}", worst));
}

/// A disk-shaped tool, pressed under a block that is held, turns: friction is mu N, its torque the radius times that, its power all lost.
struct DrumFigures {
  double torque, loss, normal;
};
DrumFigures turn_drum(const char* shape_functions, const Plane& shift, As as) {
  constexpr double radius = 20, spin = 0.002, end = 240, sliding = 140;
  const Placement at{0, shift};
  std::string text = text_of({.shape_functions = shape_functions, .reach = 36, .end = end, .damping = 0.3, .law = rubbing(), .nu = 0.3});
  text += rectangle_body(at, Made::of_shape, -5, radius, 5, radius + 8);
  text += fmt::format("[[rigid]]\nname = \"grip\"\nrole = \"boundary\"\nshape = {}\n{}",
                      at.shape(rectangle(-7, radius + 7.5, 7, radius + 10)), triangle(at, 0, -1, 0.3, 60));
  const std::string motion = fmt::format("spin = [{{ times = [0, 60, 80], values = [0, 0, {}] }}]\n", spin);
  if (as == As::wall)
    text += fmt::format("[[wall]]\nname = \"drum\"\nkind = \"ball\"\ncentre = {}\nradius = {}\n{}", at.text_of_point(0, 0), radius, motion);
  else
    text += fmt::format("[[rigid]]\nname = \"drum\"\nshape = {}\nspin_centre = {}\n{}", at.shape(disk(0, 0, radius)),
                        at.text_of_point(0, 0), motion);
  const auto simulation = make(text);
  double force = 0, torque = 0, loss = 0, time = 0, before = 0;
  run(*simulation, [&](Simulation& s) {
    const double dt = s.time() - before;
    before = s.time();
    if (s.time() < sliding) {
      loss = value(s, "friction_loss");
      return;
    }
    force += value(s, "reaction_y.drum") * dt;
    torque += value(s, "torque_z.drum") * dt;
    time += dt;
  });
  loss = value(*simulation, "friction_loss") - loss;
  return {torque / (friction * radius * force), loss / (torque * spin), force / time};
}

class TurningTool : public testing::TestWithParam<Turned> {};
TEST_P(TurningTool, RubsAsADrumThatIsAWall) {
  double torque = 0, torque_of_wall = 0, loss = 0, normal = 0;
  for (const Plane& shift : places(2)) {
    const DrumFigures d = turn_drum(GetParam().shape_functions, shift, As::shape);
    const DrumFigures wall = turn_drum(GetParam().shape_functions, shift, As::wall);
    EXPECT_NEAR(d.torque, 1, 0.01) << shift.first << ", " << shift.second;
    EXPECT_NEAR(d.loss, 1, 0.01) << shift.first << ", " << shift.second;
    EXPECT_NEAR(d.normal, wall.normal, 0.01 * wall.normal) << shift.first << ", " << shift.second;
    torque = std::fmax(torque, std::fabs(d.torque - 1));
    torque_of_wall = std::fmax(torque_of_wall, std::fabs(wall.torque - 1));
    loss = std::fmax(loss, std::fabs(d.loss - 1));
    normal = std::fmax(normal, std::fabs(d.normal / wall.normal - 1));
  }
  RecordProperty("worst_torque", fmt::format("{:.4f}", torque));
  RecordProperty("worst_torque_of_a_wall", fmt::format("{:.4f}", torque_of_wall));
  RecordProperty("worst_loss", fmt::format("{:.4f}", loss));
  RecordProperty("worst_N_against_wall", fmt::format("{:.4f}", normal));
}
INSTANTIATE_TEST_SUITE_P(Drums, TurningTool, testing::Values(Turned{"linear"}, Turned{"bspline"}),
                         [](const auto& of) { return std::string(of.param.shape_functions); });
INSTANTIATE_TEST_SUITE_P(HolesFull, TurningHole, testing::Values(Turned{"gimp"}));
INSTANTIATE_TEST_SUITE_P(DrumsFull, TurningTool, testing::Values(Turned{"gimp"}));

/// A tool that has turned before it meets the layer is the tool given so, whatever its shape: forces and torques, but for what round-off does
/// where it lets a node stick a step earlier or later.
TEST(TurnedShape, MeetsAsIfGivenSo) {
  const std::pair<std::string, double> shapes[] = {
      // with the height of its lowest point once it has turned
      {rectangle(-4, 1, 3, 4), -0.93},
      {"{ kind = \"polygon\", corners = [[-4, 2], [0, 0], [3, 3], [1, 6], [-1, 3]] }", -0.47},
      {fmt::format("{{ kind = \"difference\", of = {}, without = [{}] }}", disk(0, 4, 4), disk(1, 1, 2)), 0},
      {"{ kind = \"ellipse\", centre = [0, 4], semi_axes = [4, 2], angle = \"20 deg\" }", 0.02},
  };
  constexpr double turn = 1.1, turning = 20, pressing = 60, end = 120;  // rad, s
  double worst = 0;
  for (const auto& [shape, lowest] : shapes) {
    const double down = 4.3 + lowest;  // into the layer by .3
    const auto problem = [&, shape = shape](bool given) {
      const std::string given_so = fmt::format("{{ kind = \"rotated\", of = {}, angle = {}, about = [0, 4] }}", shape, turn);
      std::string text = text_of(
          {.shape_functions = "gimp", .reach = 20, .end = end, .damping = 0.3, .law = rubbing(), .material = "neo_hookean", .nu = 0.3});
      text += rectangle_body({}, Made::of_shape, -10, -10, 10, -4);
      text += fmt::format("[[rigid]]\nname = \"base\"\nrole = \"boundary\"\nshape = {}\n", rectangle(-11, -12, 11, -9.5));
      text += fmt::format("[[rigid]]\nname = \"tool\"\nspin_centre = [0, 4]\nshape = {}\n", given ? given_so : shape);
      text +=
          fmt::format("velocity = [{{ times = [{0}, {1}], values = [0, 0.02] }}, {{ times = [{2}, {3}, {0}], values = [0, {4}, 0] }}]\n",
                      pressing, pressing + 5, turning, (turning + pressing) / 2, -2 * down / (pressing - turning));
      if (!given)
        text += fmt::format("spin = [{{ times = [0, {}, {}], values = [0, {}, 0] }}]\n", turning / 2, turning, 2 * turn / turning);
      return make(text);
    };
    const auto given = problem(true), turned = problem(false);
    double largest = 0, apart = 0;
    while (!given->finished()) {
      given->step(HUGE_VAL);
      turned->step(HUGE_VAL);
      for (const char* column : {"reaction_x.tool", "reaction_y.tool", "torque_z.tool"}) {
        largest = std::fmax(largest, std::fabs(value(*given, column)));
        apart = std::fmax(apart, std::fabs(value(*given, column) - value(*turned, column)));
      }
    }
    EXPECT_GT(largest, 0.01) << shape;
    EXPECT_LT(apart, 1e-4 * largest) << shape;
    worst = std::fmax(worst, largest > 0 ? apart / largest : HUGE_VAL);
  }
  RecordProperty("worst_difference", fmt::format("{:.1e}", worst));
}

/// A disk at rest in a shape carries its weight on it, whatever corners and curves that has; two faces share it as they lean.
/// Not all met: .9918 of the weight in a groove, .9963 in a ring at the time (uGIMP); it still sinks.
TEST(DiskInShapeFull, RestsOnIt) {
  const double q = 8 * std::sqrt(2.);
  const std::string shapes[] = {
      // A groove of a right angle, a bowl, a round hole in a plate, a floor of two halves that meet below the disk.
      fmt::format("{{ kind = \"polygon\", corners = [[0, {0}], [12, {1}], [12, -16], [-12, -16], [-12, {1}]] }}", -q, 12 - q),
      fmt::format("{{ kind = \"difference\", of = {}, without = [{}] }}", rectangle(-12, -14, 12, 0), disk(0, 4, 12)),
      fmt::format("{{ kind = \"ring\", centre = [0, 1], inner = 9, outer = 12 }}"),
      fmt::format("{{ kind = \"union\", of = [{}, {}] }}", rectangle(-12, -12, 0, -8), rectangle(0, -12, 12, -8)),
  };
  double worst = 0, aside = 0;
  for (const std::string& shape : shapes) {
    for (const char* shape_functions : all_shape_functions()) {
      constexpr double end = 300, settled = 250, g = 5e-4;
      const Placement at{0, {0.3, 0.4}};
      std::string text = text_of({.shape_functions = shape_functions, .reach = 18, .end = end, .damping = 0.12, .nu = 0.3});
      text.replace(text.find("damping"), 0, fmt::format("body_force = [0, {{ times = [0, 60], values = [0, {}] }}]\n", -g));
      text += body(at, grains_of_disk(0, 0, 8, 0.5));
      text += fmt::format("[[rigid]]\nname = \"floor\"\nshape = {}\n", at.shape(shape));
      const auto simulation = make(text);
      double x = 0, y = 0, time = 0, before = 0;
      run(*simulation, [&](Simulation& s) {
        const double dt = s.time() - before;
        before = s.time();
        if (s.time() < settled) return;
        x += value(s, "reaction_x.floor") * dt;
        y += value(s, "reaction_y.floor") * dt;
        time += dt;
      });
      const double weight = g * std::numbers::pi * 64;
      EXPECT_NEAR(y / time, weight, 0.003 * weight) << shape << ", " << shape_functions;
      EXPECT_NEAR(x / time, 0, 0.01 * weight) << shape << ", " << shape_functions;
      worst = std::fmax(worst, std::fabs(y / time / weight - 1));
      aside = std::fmax(aside, std::fabs(x / time / weight));
    }
  }
  RecordProperty("worst_error_of_weight", fmt::format("{:.4f}", worst));
  RecordProperty("worst_force_aside", fmt::format("{:.4f}", aside));
}

}  // namespace
}  // namespace crampon::test
