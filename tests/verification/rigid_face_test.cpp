/// Rigid faces are where they are said to be: layers pressed by plates and walls at any place in a cell, and plates of any thickness.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tool_cases.hpp"

namespace crampon::test {
namespace {

/// A layer between two tools: what is above it and below it.
struct Press {
  const char* name;
  bool plate_above, plate_below;  ///< a [[rigid]] rectangle, or a [[wall]]
  bool both_move;                 ///< half of the way each
};

struct Layer {
  Press press;
  const char* shape_functions;
  double degrees;
  Made made = Made::of_shape;
  double cell_height = 1;
};
void PrintTo(const Layer& c, std::ostream* out) { *out << c.press.name << ", " << c.shape_functions << ", " << c.degrees << " degrees"; }

struct Forces {
  double above, below;  ///< over what they should be
  double ripple;        ///< of that above, at the end
};

/// A layer of this height, six cells wide, is pressed by 2 % of its height and comes to rest. With nu = 0, E = 1 and a strain that is linear in
/// the stretch the force on its six cells is 6 u/h, whatever the size of u. In elastic_small_strain of N03 strain accumulates against the
/// present length, and the initial volume bears its stress: 6 ln(h/(h - u)) h/(h - u).
/// With linear functions the points of a body that is compressed by e still fill their cells as before, until they cross: forces are
/// 1.5 e too small, 3 % at 2 % (e with the law of N03: 3 % below its own, and that of the initial length), wherever the face. So .5 % there.
Forces press(const Layer& c, int height, const Plane& shift, const char* material = "elastic_large_rotation") {
  constexpr double width = 6;
  const double strain = std::string(c.shape_functions) == "linear" ? 0.005 : 0.02;
  // A way that is a triangle over two periods of the layer between its tools leaves none of its waves; damping takes what is left.
  const double period = 2 * height, pressing = 2 * period, end = pressing + 3 * period;
  const Placement at{c.degrees, {shift.first - width / 2, shift.second - height / 2.}};
  std::string text = text_of({.shape_functions = c.shape_functions,
                              .reach = std::hypot(width / 2 + 3, height / 2. + 3) + 3,
                              .end = end,
                              .damping = std::numbers::pi / height,
                              .material = material,
                              .cell_height = c.cell_height});
  text += rectangle_body(at, c.made, 0, 0, width, height, c.cell_height);
  const auto tool = [&](const char* name, bool plate, bool above, double way) {
    const double y = above ? height : 0, out = above ? 1 : -1;
    if (plate) {
      const double back = y + 2.5 * out;
      text += fmt::format("[[rigid]]\nname = \"{}\"\nshape = {}\n", name,
                          at.shape(rectangle(-1.5, std::min(y, back), width + 1.5, std::max(y, back))));
    } else {
      text += fmt::format("[[wall]]\nname = \"{}\"\npoint = {}\nnormal = {}\n", name, at.text_of_point(width / 2, y),
                          at.text(at.direction(0, -out)));
    }
    if (way > 0) text += triangle(at, 0, -out, way, pressing);
  };
  const double way = strain * height;
  tool("above", c.press.plate_above, true, c.press.both_move ? way / 2 : way);
  tool("below", c.press.plate_below, false, c.press.both_move ? way / 2 : 0);
  const auto simulation = make(text);
  double time = 0, before = 0, above = 0, below = 0, least = HUGE_VAL, most = -HUGE_VAL;
  run(*simulation, [&](Simulation& s) {
    const double dt = s.time() - before;
    before = s.time();
    if (s.time() < end - period) return;
    const double f = -at.back({value(s, "reaction_x.above"), value(s, "reaction_y.above")}).second;
    time += dt;
    above += f * dt;
    below += at.back({value(s, "reaction_x.below"), value(s, "reaction_y.below")}).second * dt;
    least = std::fmin(least, f);
    most = std::fmax(most, f);
  });
  const bool accumulates = std::string(material) == "elastic_small_strain";
  const double exact = width * (accumulates ? -std::log(1 - strain) / (1 - strain) : strain);
  return {above / time / exact, below / time / exact, (most - least) / exact};
}

/// Worst of many places of the layer in a cell.
void expect_force(const Layer& c, const std::vector<int>& heights, int places, testing::Test& test) {
  double worst = 0, ripple = 0;
  std::string where;
  for (const int height : heights) {
    double worst_here = 0;
    for (int k = 0; k < places; ++k) {
      const double y = (k + 0.05) / places, x = std::fmod(7 * y, 1.);
      const Forces f = press(c, height, {x, y});
      for (const double error : {std::fabs(f.above - 1), std::fabs(f.below - 1)}) {
        worst_here = std::fmax(worst_here, std::isnan(error) ? HUGE_VAL : error);
        if (worst_here > worst) {
          worst = worst_here;
          where = fmt::format("{} cells, at {:.4f} of a cell: above {:.4f}, below {:.4f}", height, y, f.above, f.below);
        }
      }
      ripple = std::fmax(ripple, f.ripple);
    }
    test.RecordProperty(fmt::format("worst_error_{}_cells", height), fmt::format("{:.4f}", worst_here));
  }
  EXPECT_LT(worst, 0.01) << where;
  EXPECT_LT(ripple, 0.005) << "not at rest";
}

constexpr Press presses[] = {{"plate_on_wall", true, false, false},
                             {"wall_on_plate", false, true, false},
                             {"two_plates", true, true, true},
                             {"two_walls", false, false, true}};

/// The others are in Full, and not all of them bear what they should within 1 %: of shapes turned by 30 degrees layers of four cells do not (up to
/// 1.020 with linear functions, 1.015 with uGIMP between two faces); of particles from a file nobody knows the surface (at 30 degrees up to 6 %, and B-splines straight read 1.013 and go on trembling by .6 %), and with linear functions rows of them cross
/// nodes (up to 33 %), whatever they meet.
bool is_met(const Layer& c) {
  const std::string shape_functions = c.shape_functions;
  return c.made == Made::of_shape ? c.degrees == 0 || shape_functions == "bspline" : c.degrees == 0 && shape_functions == "gimp";
}

enum class Which { all, met };
std::vector<Layer> layers(Made made, Which which) {
  std::vector<Layer> some;
  for (const Press& press : presses) {
    for (const char* shape_functions : all_shape_functions()) {
      for (const double degrees : {0., 30.}) {
        const Layer c{press, shape_functions, degrees, made};
        if (which == Which::all || is_met(c)) some.push_back(c);
      }
    }
  }
  return some;
}

std::string name_of(const testing::TestParamInfo<Layer>& of) {
  return fmt::format("{}_{}_{:.0f}", of.param.press.name, of.param.shape_functions, of.param.degrees);
}

/// Cells: the least height of a layer of which no node sees both faces.
int least_height(const std::string& shape_functions) {
  return static_cast<int>(std::fmax(4, std::ceil(2 * boxes_of(kind_of_word(shape_functions)).reach(0.25) + 1)));
}

class PressedLayer : public testing::TestWithParam<Layer> {};
TEST_P(PressedLayer, BearsItsForceAnywhereInACell) { expect_force(GetParam(), {least_height(GetParam().shape_functions), 8}, 4, *this); }
INSTANTIATE_TEST_SUITE_P(Shapes, PressedLayer, testing::ValuesIn(layers(Made::of_shape, Which::met)), name_of);
INSTANTIATE_TEST_SUITE_P(Particles, PressedLayer, testing::ValuesIn(layers(Made::of_particles, Which::met)), name_of);

class PressedLayerFull : public testing::TestWithParam<Layer> {};
TEST_P(PressedLayerFull, BearsItsForceAnywhereInACell) {
  expect_force(GetParam(), {least_height(GetParam().shape_functions), 8, 16}, 20, *this);
}
INSTANTIATE_TEST_SUITE_P(Shapes, PressedLayerFull, testing::ValuesIn(layers(Made::of_shape, Which::all)), name_of);
INSTANTIATE_TEST_SUITE_P(Particles, PressedLayerFull, testing::ValuesIn(layers(Made::of_particles, Which::all)), name_of);

/// The law of N03, whose force at 2 % is 3.1 % above that of the same modulus against the initial length, at .5 % .8 %.
TEST(PressedLayerOfN03, BearsItsForce) {
  double worst = 0;
  for (const char* shape_functions : all_shape_functions()) {
    for (const double y : {0., 0.33, 0.71}) {
      const Forces f = press({presses[0], shape_functions, 0}, 8, {0.2, y}, "elastic_small_strain");
      for (const double force : {f.above, f.below}) {
        EXPECT_NEAR(force, 1, 0.01) << shape_functions << " at " << y;
        worst = std::fmax(worst, std::fabs(force - 1));
      }
    }
  }
  RecordProperty("worst_error", fmt::format("{:.4f}", worst));
}

/// Cells twice as long as high, and the reverse, under walls and plates: the layer and its force are the same.
TEST(PressedLayerOnLongCells, BearsItsForce) {
  double worst = 0;
  for (const char* shape_functions : all_shape_functions()) {
    for (const double height : {0.5, 2.}) {
      for (const double y : {0.05, 0.55}) {
        Layer c{presses[0], shape_functions, 0};
        c.cell_height = height;
        const Forces f = press(c, 8, {0.2, y * height});
        for (const double force : {f.above, f.below}) {
          EXPECT_NEAR(force, 1, 0.01) << shape_functions << " at " << y << ", cells of " << height;
          worst = std::fmax(worst, std::fabs(force - 1));
        }
      }
    }
  }
  RecordProperty("worst_error", fmt::format("{:.4f}", worst));
}

/// In space: a block of 4 x 4 x 4 cells between boxes, and between walls.
TEST(PressedLayerInSpaceFull, BearsItsForce) {
  double worst = 0;
  for (const char* shape_functions : all_shape_functions()) {
    for (const bool plates : {true, false}) {
      for (const double place : {0.5}) {
        constexpr double height = 4, period = 2 * height, end = 5 * period;
        const double strain = std::string(shape_functions) == "linear" ? 0.005 : 0.02;
        std::string text =
            text_in_space({.shape_functions = shape_functions, .end = end, .damping = std::numbers::pi / height}, {-4, -4, -4}, {8, 8, 12});
        text += fmt::format("[[body]]\nname = \"block\"\nmaterial = \"m\"\nshape = {}\n", box(0, 0, place, 4, 4, place + height));
        const auto tool = [&](const char* name, double z, double out) {
          if (plates) {
            text += fmt::format("[[rigid]]\nname = \"{}\"\nshape = {}\n", name,
                                box(-1, -1, std::min(z, z + 2 * out), 5, 5, std::max(z, z + 2 * out)));
          } else {
            text += fmt::format("[[wall]]\nname = \"{}\"\npoint = [0, 0, {}]\nnormal = [0, 0, {}]\n", name, z, -out);
          }
        };
        tool("below", place, -1);
        tool("above", place + height, 1);
        text += fmt::format("velocity = [0, 0, {{ times = [0, {}, {}], values = [0, {}, 0] }}]\n", period, 2 * period,
                            -strain * height / period);
        const auto simulation = make(text);
        double time = 0, before = 0, force[2] = {};
        run(*simulation, [&](Simulation& s) {
          const double dt = s.time() - before;
          before = s.time();
          if (s.time() < end - period) return;
          time += dt;
          force[0] -= value(s, "reaction_z.above") * dt;
          force[1] += value(s, "reaction_z.below") * dt;
        });
        for (const double f : force) {
          EXPECT_NEAR(f / time, 16 * strain, 0.01 * 16 * strain)
              << shape_functions << ", " << (plates ? "plates" : "walls") << " at " << place;
          worst = std::fmax(worst, std::fabs(f / time / (16 * strain) - 1));
        }
      }
    }
  }
  RecordProperty("worst_error", fmt::format("{:.4f}", worst));
}

struct Sheet {
  const char* shape_functions;
  double degrees;
};
void PrintTo(const Sheet& c, std::ostream* out) { *out << c.shape_functions << ", " << c.degrees << " degrees"; }

struct Bounce {
  double momentum;  ///< at the end, over that at the start, away from the plate
  double height;    ///< of the lowest particle above the plate's face, then
};

/// A block of eight cells flies at a plate of this thickness with 2 % of the speed of its waves. Contact lasts 2 L/c.
Bounce bounce(const Sheet& c, double thickness, const Plane& shift) {
  constexpr double side = 8, speed = 0.02, gap = 0.2;
  const Placement at{c.degrees, shift};
  const Plane v = at.direction(0, -speed);
  const double end = gap / speed + 6 * side;
  std::string text = text_of({.shape_functions = c.shape_functions, .reach = 20, .end = end, .material = "neo_hookean"});
  text += body(at, grains_of_rectangle(-side / 2, gap, side / 2, gap + side),
               fmt::format("velocity = [{:.17g}, {:.17g}]\n", v.first, v.second));
  text += fmt::format("[[rigid]]\nname = \"plate\"\nshape = {}\n", at.shape(rectangle(-8, -thickness, 8, 0)));
  const auto simulation = make(text);
  run(*simulation);
  Bounce b{at.back({value(*simulation, "momentum_x"), value(*simulation, "momentum_y")}).second / (side * side * speed), HUGE_VAL};
  const PointFrame frame = simulation->particles();
  for (std::size_t p = 0; p < frame.positions.size() / 3; ++p) {
    if (field(frame, "body").values[p] != 0) continue;
    b.height = std::fmin(b.height, at.back({frame.positions[3 * p], frame.positions[3 * p + 1]}).second - shift.second);
  }
  return b;
}

/// Contact takes energy at its onset, the more of it the fewer cells: a thick plate throws the block back with some .8 of its momentum.
void expect_bounce(const Sheet& c, const std::vector<double>& places, testing::Test& test) {
  double worst = 0, least = HUGE_VAL;
  for (const double place : places) {
    const Plane shift{0.3, place};
    const double thick = bounce(c, 4, shift).momentum;
    least = std::fmin(least, thick);
    for (const double thickness : {0.1, 0.25, 0.5, 1., 2.}) {
      const Bounce b = bounce(c, thickness, shift);
      const std::string where = fmt::format("{} cells thick, at {} of a cell", thickness, place);
      EXPECT_NEAR(b.momentum, thick, 0.03 * std::fabs(thick)) << where;
      EXPECT_GT(b.height, 0.45) << where << ": it has left the plate";  // 32 c t at .016 c
      worst = std::fmax(worst, std::fabs(b.momentum / thick - 1));
    }
  }
  EXPECT_GT(least, 0.6) << "a thick plate";
  test.RecordProperty("worst_against_thick_plate", fmt::format("{:.4f}", worst));
  test.RecordProperty("least_of_thick_plate", fmt::format("{:.4f}", least));
}

class ThinPlate : public testing::TestWithParam<Sheet> {};
TEST_P(ThinPlate, ThrowsBackAsAThickOne) { expect_bounce(GetParam(), {0, 0.55}, *this); }
INSTANTIATE_TEST_SUITE_P(Plates, ThinPlate, testing::ValuesIn(for_all_shape_functions<Sheet>([](const char* shape) {
                           return std::vector<Sheet>{{shape, 0}, {shape, 30}};
                         })),
                         [](const auto& of) { return fmt::format("{}_{:.0f}", of.param.shape_functions, of.param.degrees); });

/// The same in space: a cube of four cells on a box of a quarter and of three cells.
TEST(ThinPlateInSpaceFull, ThrowsBackAsAThickOne) {
  const auto momentum = [](const char* shape_functions, double thickness) {
    constexpr double speed = 0.02;
    std::string text = text_in_space({.shape_functions = shape_functions, .end = 34, .material = "neo_hookean"}, {-6, -6, -6}, {6, 6, 10});
    text +=
        fmt::format("[[body]]\nname = \"cube\"\nmaterial = \"m\"\nshape = {}\nvelocity = [0, 0, {}]\n", box(-2, -2, 0, 2, 2, 4), -speed);
    text += fmt::format("[[rigid]]\nname = \"plate\"\nshape = {}\n", box(-4, -4, -0.2 - thickness, 4, 4, -0.2));
    const auto simulation = make(text);
    run(*simulation);
    return value(*simulation, "momentum_z") / (64 * speed);
  };
  double worst = 0;
  for (const char* shape_functions : all_shape_functions()) {
    const double thick = momentum(shape_functions, 3), thin = momentum(shape_functions, 0.25);
    EXPECT_GT(thick, 0.6) << shape_functions;
    EXPECT_NEAR(thin, thick, 0.03 * thick) << shape_functions;
    worst = std::fmax(worst, std::fabs(thin / thick - 1));
  }
  RecordProperty("worst_against_thick_plate", fmt::format("{:.4f}", worst));
}

/// The patch test of decision 0018: impulses by the nodes' parts of a face hold the forces of a uniform stress node by node. A layer that bears
/// a pressure of .01 from the start between two rigid faces stays at rest, wherever the faces lie in the cells. (At an angle the free sides of a
/// body are stairs of particles, which no uniform stress leaves at rest.) What is left is
/// round-off: speeds of 1e-15 of those that the pressure would give in a step (.01 dt/cell), over 20 steps.
TEST(UniformStress, RestsBetweenRigidFaces) {
  double worst = 0;
  for (const char* shape_functions : all_shape_functions()) {
    // Higher than what a node sees up and down. Where nodes see both faces the layer does not rest exactly, with any shape function: three cells
    // high it moves at 1e-4 (linear, uGIMP), 6e-4 (quadratic B-splines) and 8e-3 (cubic ones).
    const double height = least_height(shape_functions);
    for (const double degrees : {0., 90., 180.}) {
      for (const Plane& shift : places(5)) {
        const Placement at{degrees, {shift.first - 3, shift.second - height / 2}};
        const Plane n = at.direction(0, 1);
        std::string text = text_of({.shape_functions = shape_functions, .reach = 10, .end = 6, .material = "elastic_small_strain"});
        text += rectangle_body(at, Made::of_shape, 0, 0, 6, height);
        text += fmt::format("initial_stress = {{ kind = \"components\", xx = {:.17g}, yy = {:.17g}, xy = {:.17g} }}\n",
                            -0.01 * n.first * n.first, -0.01 * n.second * n.second, -0.01 * n.first * n.second);
        text += fmt::format("[[rigid]]\nname = \"above\"\nshape = {}\n", at.shape(rectangle(-2, height, 8, height + 2)));
        text += fmt::format("[[wall]]\nname = \"below\"\npoint = {}\nnormal = {}\n", at.text_of_point(0, 0), at.text(n));
        const auto simulation = make(text);
        double most = 0;
        run(*simulation, [&](Simulation& s) { most = std::fmax(most, std::sqrt(2 * value(s, "kinetic_energy"))); });
        EXPECT_LT(most, 1e-12) << shape_functions << " at " << degrees << " degrees, " << shift.second << " of a cell";
        worst = std::fmax(worst, most);
      }
    }
  }
  RecordProperty("most_speed_times_root_of_mass", fmt::format("{:.1e}", worst));
}

/// Two bodies on each other, or one with a crack along the face, fall on a wall: where the pairs of a node and the columns of a face share nodes they
/// are solved together. Solved one after the other they made up to twelve times the energy. The bound is what the bounce of one body makes and loses, 2 %.
TEST(StackOnAWall, MakesNoEnergy) {
  double worst = 0;
  for (const char* shape_functions : all_shape_functions()) {
    for (const double height : {0.75, 1., 1.25, 1.5, 1.75, 2., 2.5}) {
      for (const char* parted : {"bodies", "crack"}) {
        std::string text = text_of({.shape_functions = shape_functions, .reach = 10, .end = 30, .material = "neo_hookean", .nu = 0.3});
        const auto add = [&](const char* name, double low, double high) {
          text += fmt::format("[[body]]\nname = \"{}\"\nmaterial = \"m\"\nshape = {}\nvelocity = [0.01, -0.06]\n", name,
                              rectangle(-3, low, 3, high));
        };
        if (std::string(parted) == "bodies") {
          add("lower", 0, height);
          add("upper", height, 6);
        } else {
          add("both", 0, 6);
          text += fmt::format("[[crack]]\npoints = [[-5, {0}], [5, {0}]]\ncontact = \"frictionless\"\n", height + 0.01);
        }
        text += "[[wall]]\nname = \"floor\"\npoint = [0, 0]\nnormal = [0, 1]\n";
        const auto simulation = make(text);
        const double start = value(*simulation, "total_energy");
        double most = 0;
        run(*simulation, [&](Simulation& s) { most = std::fmax(most, value(s, "total_energy") / start - 1); });
        EXPECT_LT(most, 0.02) << shape_functions << ", " << parted << " at " << height;
        worst = std::fmax(worst, most);
      }
    }
  }
  RecordProperty("most_gain", fmt::format("{:.4f}", worst));
}

/// Joints of bodies in one field, and symmetry planes, are no surfaces: a block in two parts, side by side or on each other, and half a block, meet
/// tools as the whole block does. Forces over 30 steps, to round-off.
TEST(JoinedBlock, MeetsToolsAsOne) {
  const std::string tools[] = {disk(0, -2, 2.2), rectangle(-0.3, -3, 0.3, 0.13), rectangle(-5, -2, 5, 0.13)};
  double worst = 0;
  for (const char* shape_functions : all_shape_functions()) {
    for (const std::string& tool : tools) {
      const auto force = [&](const std::vector<std::string>& parts, bool half) {
        std::string text = text_of({.shape_functions = shape_functions, .reach = 10, .end = 12, .material = "neo_hookean", .nu = 0.3});
        text.replace(text.find("fields = \"bodies\""), 17, "fields = \"materials\"");
        if (half) text += "[[symmetry]]\naxis = \"x\"\nat = 0\n";
        for (std::size_t p = 0; p < parts.size(); ++p)
          text += fmt::format("[[body]]\nname = \"{}\"\nmaterial = \"m\"\nshape = {}\nvelocity = [0, -0.06]\n", p, parts[p]);
        text += fmt::format("[[rigid]]\nname = \"tool\"\nshape = {}\n", tool);
        const auto simulation = make(text);
        std::vector<double> course;
        run(*simulation, [&](Simulation& s) { course.push_back((half ? 2 : 1) * value(s, "reaction_y.tool")); });
        return course;
      };
      const std::vector<double> whole = force({rectangle(-4, 0.5, 4, 6.5)}, false);
      double most = 0;
      for (const double f : whole) most = std::fmax(most, std::fabs(f));
      EXPECT_GT(most, 0) << tool;
      const std::vector<double> others[] = {force({rectangle(-4, 0.5, 0, 6.5), rectangle(0, 0.5, 4, 6.5)}, false),
                                            force({rectangle(-4, 0.5, 4, 1), rectangle(-4, 1, 4, 6.5)}, false),
                                            force({rectangle(0, 0.5, 4, 6.5)}, true)};
      for (const std::vector<double>& other : others) {
        ASSERT_EQ(other.size(), whole.size());
        for (std::size_t k = 0; k < whole.size(); ++k) {
          EXPECT_NEAR(other[k], whole[k], 1e-9 * most) << shape_functions << ", " << tool << ", " << &other - others << ", step " << k;
          worst = std::fmax(worst, std::fabs(other[k] - whole[k]) / most);
        }
      }
    }
  }
  RecordProperty("worst_difference", fmt::format("{:.1e}", worst));
}

}  // namespace
}  // namespace crampon::test
