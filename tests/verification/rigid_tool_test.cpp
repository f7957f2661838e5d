/// Rigid tools of any shape rub with the friction that the law says: flat, rounded and hollow ones, turning ones, anywhere on the grid.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tool_cases.hpp"

namespace crampon::test {
namespace {

struct Tool {
  const char* name;
  std::string shape;      ///< its lowest points at y = 0, about x = 0
  double reach;           ///< half of its width, cells
  double width, height;   ///< of the layer, cells
  double depth;           ///< by which it is pressed in
  const char* wall = "";  ///< the kind of [[wall]] that does as well, if any
};

struct Dragged {
  const Tool* tool;
  const char* shape_functions;
  double degrees;
  Made made = Made::of_shape;
};
void PrintTo(const Dragged& c, std::ostream* out) { *out << c.tool->name << ", " << c.shape_functions << ", " << c.degrees << " degrees"; }

struct Drag {
  double normal, ratio;     ///< N and T/N in the mean while it slides
  double least, most;       ///< T/N in fifths of that time
  double least_normal = 0;  ///< likewise
  double torque;            ///< about the tool's origin
};

/// A tool is pressed into a layer that is held at its foot, and then moves along it, to positive x.
Drag drag(const Dragged& c, const Plane& shift, As as = As::shape, const std::string& law = rubbing()) {
  const Tool& tool = *c.tool;
  const Placement at{c.degrees, shift};
  const double period = 2 * tool.height, pressing = 2 * period, speed = 0.04;
  // Slides once the layer has sheared by what friction can hold, under a cell; then for two cells and a half.
  const double start = pressing + period / 2, sliding = start + 1.5 / speed, end = sliding + 2.5 / speed;
  std::string text = text_of({.shape_functions = c.shape_functions,
                              .reach = std::hypot(std::max(tool.width / 2, tool.reach + 4) + 3, std::max(tool.height + 4, 9.)) + 3,
                              .end = end,
                              .damping = 2 / tool.height,
                              .law = law,
                              .material = "neo_hookean",
                              .nu = 0.3});
  text += rectangle_body(at, c.made, -tool.width / 2, -tool.height, tool.width / 2, 0, 1, *tool.wall == 'b');
  text += fmt::format("[[rigid]]\nname = \"base\"\nrole = \"boundary\"\nshape = {}\n",
                      at.shape(rectangle(-tool.width / 2 - 1, -tool.height - 3, tool.width / 2 + 1, -tool.height + 0.5)));
  const Plane along = at.direction(1, 0), down = at.direction(0, -1);
  const auto component = [&](double x, double y) {
    return fmt::format("{{ times = [0, {}, {}, {}, {}], values = [0, {:.17g}, 0, 0, {:.17g}] }}", pressing / 2, pressing, start,
                       start + period / 4, 2 * tool.depth / pressing * y, speed * x);
  };
  const std::string velocity =
      fmt::format("velocity = [{}, {}]\n", component(along.first, down.first), component(along.second, down.second));
  if (as == As::wall && std::string(tool.wall) == "ball")
    text += fmt::format("[[wall]]\nname = \"tool\"\nkind = \"ball\"\ncentre = {}\nradius = 15\n{}", at.text_of_point(0, 15), velocity);
  else if (as == As::wall)
    text += fmt::format("[[wall]]\nname = \"tool\"\npoint = {}\nnormal = {}\n{}", at.text_of_point(0, 0), at.text(down), velocity);
  else
    text += fmt::format("[[rigid]]\nname = \"tool\"\nspin_centre = {}\nshape = {}\n{}", at.text_of_point(0, 15), at.shape(tool.shape),
                        velocity);
  const auto simulation = make(text);
  constexpr int parts = 5;
  double T[parts] = {}, N[parts] = {}, time = 0, before = 0, torque = 0;
  run(*simulation, [&](Simulation& s) {
    const double dt = s.time() - before;
    before = s.time();
    if (s.time() < sliding) return;
    const int part = std::min(parts - 1, static_cast<int>(parts * (s.time() - sliding) / (end - sliding)));
    const Plane f = at.back({value(s, "reaction_x.tool"), value(s, "reaction_y.tool")});
    T[part] += f.first * dt;
    N[part] -= f.second * dt;
    torque += value(s, "torque_z.tool") * dt;
    time += dt;
  });
  Drag d{0, 0, HUGE_VAL, -HUGE_VAL, HUGE_VAL, torque / time};
  double whole_T = 0, whole_N = 0;
  for (int part = 0; part < parts; ++part) {
    whole_T += T[part];
    whole_N += N[part];
    d.least = std::fmin(d.least, T[part] / N[part]);
    d.most = std::fmax(d.most, T[part] / N[part]);
  }
  d.normal = whole_N / time;
  d.ratio = whole_T / whole_N;
  return d;
}

// A third of the layer wide; as wide as a plate over a short layer is not, so that it has no edges on the layer; two feet; and the bottom of a
// disk of 15 cells.
const Tool flat{"flat", rectangle(-4, 0, 4, 4), 4, 24, 6, 0.06};
const Tool plate{"plate", rectangle(-12, 0, 12, 4), 12, 8, 6, 0.15, "half_space"};
const Tool feet{
    "feet", fmt::format("{{ kind = \"difference\", of = {}, without = [{}] }}", rectangle(-6, 0, 6, 5), rectangle(-2, -1, 2, 2)), 6, 26, 6,
    0.06};
// Flat, its edges rounded with a cell's radius.
const Tool blunt{"blunt",
                 fmt::format("{{ kind = \"union\", of = [{}, {}, {}, {}] }}", rectangle(-3, 0, 3, 4), rectangle(-4, 1, 4, 4),
                             disk(-3, 1, 1), disk(3, 1, 1)),
                 4,
                 24,
                 6,
                 0.06};
const Tool rounded{
    "rounded", fmt::format("{{ kind = \"intersection\", of = [{}, {}] }}", disk(0, 15, 15), rectangle(-20, -1, 20, 8)), 14, 30, 6, 0.6,
    "ball"};

/// Least and most of something over many places.
struct Range {
  double least = HUGE_VAL, most = -HUGE_VAL;
  void take(double x) {
    least = std::fmin(least, x);
    most = std::fmax(most, x);
  }
  std::string text() const { return fmt::format("{:.4f} to {:.4f}", least, most); }
};

void expect_friction(const Dragged& c, int count, testing::Test& test) {
  Range ratio, part, against_wall;
  for (const Plane& shift : places(count)) {
    const Drag d = drag(c, shift);
    const std::string where = fmt::format("at {:.3f}, {:.3f} of a cell", shift.first, shift.second);
    EXPECT_GT(d.normal, 0) << where;
    EXPECT_GE(d.ratio, 0.297) << where;
    EXPECT_LE(d.ratio, 0.303) << where;
    ratio.take(d.ratio);
    part.take(d.least);
    part.take(d.most);
    if (*c.tool->wall == 0) continue;
    const Drag wall = drag(c, shift, As::wall);
    EXPECT_NEAR(d.normal, wall.normal, 0.01 * wall.normal) << where;
    EXPECT_NEAR(d.ratio, wall.ratio, 0.003) << where;
    against_wall.take(d.normal / wall.normal);
  }
  test.RecordProperty("T_over_N", ratio.text());
  test.RecordProperty("T_over_N_in_fifths", part.text());
  if (*c.tool->wall) test.RecordProperty("N_over_that_of_a_wall", against_wall.text());
}

std::vector<Dragged> dragged(std::initializer_list<const Tool*> tools, Made made = Made::of_shape) {
  std::vector<Dragged> all;
  for (const Tool* tool : tools)
    for (const char* shape_functions : all_shape_functions())
      for (const double degrees : {0., 30.}) all.push_back({tool, shape_functions, degrees, made});
  return all;
}
std::string name_of(const testing::TestParamInfo<Dragged>& of) {
  return fmt::format("{}_{}_{:.0f}", of.param.tool->name, of.param.shape_functions, of.param.degrees);
}

class FlatTool : public testing::TestWithParam<Dragged> {};
TEST_P(FlatTool, RubsWithItsFriction) { expect_friction(GetParam(), 2, *this); }
INSTANTIATE_TEST_SUITE_P(Tools, FlatTool, testing::ValuesIn(cases_for(Runs::every, dragged({&flat, &plate, &feet}))), name_of);
INSTANTIATE_TEST_SUITE_P(ToolsFull, FlatTool, testing::ValuesIn(cases_for(Runs::full, dragged({&flat, &plate, &feet}))), name_of);
INSTANTIATE_TEST_SUITE_P(ToolsOnParticles, FlatTool, testing::ValuesIn(dragged({&plate}, Made::of_particles)), name_of);

class FlatToolFull : public testing::TestWithParam<Dragged> {};
TEST_P(FlatToolFull, RubsWithItsFriction) { expect_friction(GetParam(), 10, *this); }
// Not all met: edges rounded with a cell's radius, and edges on particles from a file, whose surface nobody knows (docs/theory/contact.md).
INSTANTIATE_TEST_SUITE_P(Tools, FlatToolFull, testing::ValuesIn(dragged({&flat, &plate, &feet, &blunt})), name_of);
INSTANTIATE_TEST_SUITE_P(ToolsOnParticles, FlatToolFull, testing::ValuesIn(dragged({&flat, &plate, &feet, &blunt}, Made::of_particles)),
                         name_of);

/// The pressure under a rounded tool that slides leans a little, and with it T/N. About the centre of its circle friction alone has a torque:
/// mu R times the integral of pressure, which is F/sqrt(1 + mu^2) for the resultant F but for the spread of normals over the contact. With cells a third as
/// large T/N is .303 and the torque 1.0072.
void expect_rounded(const Dragged& c, int count, testing::Test& test) {
  Range ratio, ratio_of_ball, turning, turning_of_ball, normal, normal_of_ball;
  const auto turns = [](const Drag& d) { return d.torque * std::hypot(1, friction) / (15 * friction * d.normal * std::hypot(1, d.ratio)); };
  for (const Plane& shift : places(count)) {
    const Drag d = drag(c, shift), ball = drag(c, shift, As::wall);
    const std::string where = fmt::format("at {:.3f}, {:.3f} of a cell", shift.first, shift.second);
    EXPECT_NEAR(d.normal, ball.normal, 0.01 * ball.normal) << where;
    EXPECT_NEAR(d.ratio, ball.ratio, 0.003) << where;
    EXPECT_GE(d.ratio, 0.297) << where;
    EXPECT_LE(d.ratio, 0.313) << where;
    EXPECT_NEAR(turns(d), 1.0072, 0.01) << where;
    ratio.take(d.ratio);
    ratio_of_ball.take(ball.ratio);
    turning.take(turns(d));
    turning_of_ball.take(turns(ball));
    normal.take(d.normal / ball.normal);
    normal_of_ball.take(ball.normal);
  }
  test.RecordProperty("N_over_that_of_a_ball", normal.text());
  test.RecordProperty("T_over_N", ratio.text());
  test.RecordProperty("torque_over_friction", turning.text());
  test.RecordProperty("T_over_N_of_a_ball", ratio_of_ball.text());
  test.RecordProperty("torque_over_friction_of_a_ball", turning_of_ball.text());
  test.RecordProperty("N_of_a_ball", normal_of_ball.text());
}

class RoundedTool : public testing::TestWithParam<Dragged> {};
TEST_P(RoundedTool, RubsAndPressesAsABallDoes) { expect_rounded(GetParam(), 1, *this); }
INSTANTIATE_TEST_SUITE_P(Tools, RoundedTool,
                         testing::Values(Dragged{&rounded, "linear", 0}, Dragged{&rounded, "gimp", 0}, Dragged{&rounded, "bspline", 0}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(ToolsOnParticles, RoundedTool, testing::ValuesIn(dragged({&rounded}, Made::of_particles)), name_of);

class RoundedToolFull : public testing::TestWithParam<Dragged> {};
TEST_P(RoundedToolFull, RubsAndPressesAsABallDoes) { expect_rounded(GetParam(), 10, *this); }
// With linear functions at 30 degrees pressure leans by more than that, T/N .318 to .329, and the case is not met; its friction is (torque 1.005 to 1.013).
INSTANTIATE_TEST_SUITE_P(Tools, RoundedToolFull, testing::ValuesIn(dragged({&rounded})), name_of);

/// Without friction a round tool feels no torque about its centre, whatever the pressure and the grid: impulses act where their normal is that of the circle.
class FrictionlessRoundTool : public testing::TestWithParam<Dragged> {};
TEST_P(FrictionlessRoundTool, FeelsNoTorque) {
  double worst = 0;
  for (const As as : {As::shape, As::wall}) {
    const Drag d = drag(GetParam(), {0.3, 0.2}, as, "\"frictionless\"");
    EXPECT_GT(d.normal, 0.5);
    // With domains that stretch 1.4e-6 was measured at 30 degrees; the cause has not been traced.
    const double bar = has_domains(kind_of_word(GetParam().shape_functions)) ? 1e-5 : 1e-9;
    EXPECT_LT(std::fabs(d.torque), bar * 15 * d.normal);
    worst = std::fmax(worst, std::fabs(d.torque) / (15 * d.normal));
  }
  RecordProperty("worst_torque_over_that_of_the_force", fmt::format("{:.1e}", worst));
}
INSTANTIATE_TEST_SUITE_P(Tools, FrictionlessRoundTool, testing::Values(Dragged{&rounded, "linear", 30}, Dragged{&rounded, "bspline", 30}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(ToolsFull, FrictionlessRoundTool, testing::ValuesIn(dragged({&rounded})), name_of);

/// In space: a ball, a lying cylinder and a plate over a layer on a base that is held, drawn at an angle to the grid. Friction points against
/// the motion. Ball and plate do as the [[wall]] that is the same. Along the cylinder, where pressure has no part, friction is its share of mu N.
/// Linear functions miss it by a hair: .2939 for .2940.
TEST(ToolInSpaceFull, RubsWithItsFriction) {
  struct Solid {
    std::string shape;
    const char* wall;
  };
  const std::string cut = "{ kind = \"box\", low = [-7, -7, 0], high = [7, 7, 3.3] }";
  const Solid solids[] = {
      {fmt::format("{{ kind = \"intersection\", of = [{{ kind = \"sphere\", centre = [0, 0, 8.3], radius = 8 }}, {}] }}", cut),
       "kind = \"ball\"\ncentre = [0, 0, 8.3]\nradius = 8\n"},
      {fmt::format("{{ kind = \"intersection\", of = [{{ kind = \"cylinder\", from = [0, -7, 8.3], to = [0, 7, 8.3], radius = 8 }}, {}] }}",
                   cut),
       ""},
      {"{ kind = \"box\", low = [-7, -7, 0.3], high = [7, 7, 1.3] }", "point = [0, 0, 0.3]\nnormal = [0, 0, -1]\n"},
  };
  const auto drawn = [](const char* shape_functions, const std::string& tool) {
    constexpr double depth = 0.3, pressing = 16, start = 18, sliding = 32, end = 44;
    std::string text = text_in_space(
        {.shape_functions = shape_functions, .end = end, .damping = 0.4, .law = rubbing(), .material = "neo_hookean", .nu = 0.3},
        {-14, -14, -8}, {14, 14, 8});
    text += fmt::format("[[body]]\nname = \"layer\"\nmaterial = \"m\"\nmatch_mass = true\nshape = {}\n", box(-4, -4, -2.7, 4, 4, 0.3));
    text += fmt::format("[[rigid]]\nname = \"base\"\nrole = \"boundary\"\nshape = {}\n", box(-5, -5, -5, 5, 5, -2.2));
    const std::string along = fmt::format("times = [{}, {}]", start, start + 5);
    text += fmt::format(
        "{}\nname = \"tool\"\nvelocity = [{{ {}, values = [0, 0.04] }}, {{ {}, values = [0, 0.02] }}, {{ times = [0, {}, {}], values = [0, "
        "{}, 0] }}]\n",
        tool, along, along, pressing / 2, pressing, -2 * depth / pressing);
    const auto simulation = make(text);
    double x = 0, y = 0, z = 0, time = 0, before = 0;
    run(*simulation, [&](Simulation& s) {
      const double dt = s.time() - before;
      before = s.time();
      if (s.time() < sliding) return;
      x += value(s, "reaction_x.tool") * dt;
      y += value(s, "reaction_y.tool") * dt;
      z -= value(s, "reaction_z.tool") * dt;
      time += dt;
    });
    struct {
      double normal, along, across, y;  // N; T/N along the motion, across it, and along y
    } d{z / time, (2 * x + y) / std::sqrt(5.) / z, (2 * y - x) / std::sqrt(5.) / z, y / z};
    return d;
  };
  Range ratio, across, normal, along_cylinder;
  for (const char* shape_functions : all_shape_functions()) {
    for (const Solid& solid : solids) {
      const auto d = drawn(shape_functions, fmt::format("[[rigid]]\nshape = {}", solid.shape));
      EXPECT_GT(d.normal, 0) << shape_functions << ", " << solid.shape;
      ratio.take(d.along);
      across.take(d.across);
      if (*solid.wall == 0) {
        EXPECT_NEAR(d.y * std::sqrt(5.), friction, 0.02 * friction) << shape_functions << ", " << solid.shape;
        along_cylinder.take(d.y * std::sqrt(5.));
        continue;
      }
      const auto wall = drawn(shape_functions, fmt::format("[[wall]]\n{}", solid.wall));
      EXPECT_NEAR(d.normal, wall.normal, 0.01 * wall.normal) << shape_functions << ", " << solid.shape;
      EXPECT_NEAR(d.along, wall.along, 0.003) << shape_functions << ", " << solid.shape;
      EXPECT_NEAR(d.across, wall.across, 0.003) << shape_functions << ", " << solid.shape;
      normal.take(d.normal / wall.normal);
      if (&solid != solids) {
        EXPECT_NEAR(d.along, friction, 0.003) << shape_functions << ", " << solid.shape;
        EXPECT_NEAR(d.across, 0, 0.003) << shape_functions << ", " << solid.shape;
      }
    }
  }
  RecordProperty("T_over_N", ratio.text());
  RecordProperty("T_over_N_across", across.text());
  RecordProperty("friction_along_cylinder", along_cylinder.text());
  RecordProperty("N_over_that_of_a_wall", normal.text());
}

}  // namespace
}  // namespace crampon::test
