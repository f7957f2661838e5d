/// Cracks on each other, or so close that no particle lies between them, are one cut: the masses on both sides meet across all of them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double h = 0.05;  // m

/// A line through the middle at an angle to the axis x, moved across itself by `offset`, between two distances from the middle.
struct Line {
  double offset = 0;               ///< cells
  bool reversed = false;           ///< drawn from the other end
  const char* law = nullptr;       ///< of contact; null: that of the case
  double from = -0.85, to = 0.85;  ///< m
  int pieces = 1;                  ///< straight pieces of equal length
};

struct Case {
  const char* shape_functions = "gimp";
  const char* detection = "position";
  const char* stress_update = "usavg";
  double degrees = 0;  ///< of the line to the axis x
  double shift = 0;    ///< of all to the grid along the axis y, cells
  const char* law = "{ law = \"coulomb\", friction = 0.3 }";
  std::vector<Line> more;  ///< lines besides one through the middle
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.shape_functions << ", " << c.detection << ", " << c.stress_update << ", " << c.degrees << " degrees, " << c.law;
  for (const Line& l : c.more) *out << ", " << l.offset << (l.reversed ? " reversed" : "") << (l.law ? l.law : "");
}

std::string crack(const Case& c, const Line& line) {
  const double turn = c.degrees * std::numbers::pi / 180, co = std::cos(turn), si = std::sin(turn), y = line.offset * h;
  std::string points;
  for (int i = 0; i <= line.pieces; ++i) {
    const double part = static_cast<double>(line.reversed ? line.pieces - i : i) / line.pieces;
    const double x = line.from + part * (line.to - line.from);
    points += fmt::format("{}[{}, {}]", i ? ", " : "", co * x - si * y, si * x + co * y + c.shift * h);
  }
  return fmt::format("[[crack]]\npoints = [{}]\nfixed = true\ncontact = {}\n", points, line.law ? line.law : c.law);
}

/// Two blocks in one velocity field, pressed together at a line, and rubbed along it.
std::string problem(const Case& c, const std::vector<Line>& lines) {
  const double turn = c.degrees * std::numbers::pi / 180;
  const auto block = [&](const char* name, double bottom, double top, double u, double v) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmaterial = \"m\"\nvelocity = [{}, {}]\nshape = {{ kind = \"translated\", by = [0, {}], of = {{ kind = "
        "\"rotated\", "
        "angle = \"{} deg\", about = [0, 0], of = {{ kind = \"rectangle\", low = [-0.5, {}], high = [0.5, {}] }} }} }}\n",
        name, u * std::cos(turn) - v * std::sin(turn), u * std::sin(turn) + v * std::cos(turn), c.shift * h, c.degrees, bottom, top);
  };
  std::string text = fmt::format(R"(
[grid]
origin = [-1, -1]
size = [2, 2]
cell = {}
[time]
steps = 20
courant = 0.4
[method]
shape_functions = "{}"
stress_update = "{}"
[contact]
detection = "{}"
[[material]]
name = "m"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
)",
                                 h, c.shape_functions, c.stress_update, c.detection);
  text += block("low", -0.3, 0, -1, 0.2) + block("top", 0, 0.3, 1, -0.2);
  for (const Line& line : lines) text += crack(c, line);
  return text;
}

std::unique_ptr<Simulation> run_with(const Case& c, const std::vector<Line>& lines) {
  auto simulation = make(problem(c, lines));
  run(*simulation);
  return simulation;
}

/// The partition of particles and nodes is that of one crack, and so is the rest: to round-off of the normals, which are means of one more.
/// They were glued to each other or passed through each other before: energies differed by tens of per cent.
class OverlappingCracks : public testing::TestWithParam<Case> {};
TEST_P(OverlappingCracks, AreOneCut) {
  const Case& c = GetParam();
  std::vector<Line> lines{Line{}};
  lines.insert(lines.end(), c.more.begin(), c.more.end());
  const auto one = run_with(c, {Line{}}), several = run_with(c, lines);
  const double energy = value(*one, "kinetic_energy");
  for (const char* column : {"kinetic_energy", "strain_energy", "friction_loss", "contact_loss"})
    EXPECT_NEAR(value(*several, column), value(*one, column), 1e-11 * energy) << column;
  const Numbers one_v = field(one->particles({"velocity"}), "velocity").values;
  EXPECT_LT(difference(field(several->particles({"velocity"}), "velocity").values, one_v), 1e-11);  // m/s
  if (std::string(c.law).find("coulomb") == std::string::npos) return;
  EXPECT_GT(value(*one, "friction_loss"), 0.01 * energy);  // they do rub
}

const std::vector<Case> cases = {
    {.more = {{}}},
    {.shape_functions = "linear", .more = {{}}},
    {.shape_functions = "bspline", .more = {{}}},
    {.shape_functions = "cubic_bspline", .more = {{}}},
    {.shape_functions = "cubic_bspline", .degrees = 25, .more = {{.reversed = true}}},
    {.shape_functions = "cubic_bspline", .shift = 0.4, .more = {{.offset = 0.1, .reversed = true}}},
    {.degrees = 90, .more = {{}}},
    {.degrees = 30, .more = {{}}},
    {.shape_functions = "linear", .degrees = 30, .more = {{.reversed = true}}},
    {.shape_functions = "bspline", .degrees = -40, .more = {{.reversed = true}}},
    {.stress_update = "musl", .shift = 0.3, .more = {{.reversed = true}}},
    {.stress_update = "usl", .shift = 0.5, .more = {{}}},
    {.detection = "displacement", .degrees = 17, .more = {{}}},
    {.detection = "regression", .degrees = 17, .more = {{}}},
    {.detection = "volume", .more = {{.reversed = true}}},
    // Three, and lines with no particle between them.
    {.more = {{}, {.reversed = true}}},
    {.shift = 0.4, .more = {{.offset = 0.1}, {.offset = -0.12, .reversed = true}}},
    {.shape_functions = "bspline", .shift = 0.4, .more = {{.offset = 0.1, .reversed = true}}},
    {.shape_functions = "linear", .degrees = 90, .more = {{.offset = -0.1}}},
    // The strictest law rules.
    {.more = {{.law = "{ law = \"none\" }"}}},
    {.more = {{.law = "{ law = \"frictionless\" }"}}},
    {.more = {{.law = "{ law = \"coulomb\", friction = 0.1, static_friction = 0.2 }"}}},
    {.more = {{.law = "{ law = \"viscous\", viscosity = 10, film = 1e-3 }"}}},
    {.law = "{ law = \"stick\" }", .more = {{.law = "{ law = \"coulomb\", friction = 0.9 }"}}},
    {.law = "{ law = \"coulomb\", friction = 0.3 }", .more = {{.law = "{ law = \"bonded\" }"}}},  // bonded: as if it were not there
};
INSTANTIATE_TEST_SUITE_P(Sweep, OverlappingCracks, testing::ValuesIn(cases));

/// Pieces that overlap for a part of the way: about the tip of the second, lines from one side to a node cross one crack or both, and the
/// two fields that this makes rub on each other. Measured: 2e-4 of the energy.
class PartlyOverlappingCracks : public testing::TestWithParam<Case> {};
TEST_P(PartlyOverlappingCracks, DifferLittleFromOneCut) {
  const Case& c = GetParam();
  const auto one = run_with(c, {Line{}}), two = run_with(c, {Line{}, c.more[0]});
  const double energy = value(*one, "kinetic_energy");
  for (const char* column : {"kinetic_energy", "strain_energy", "friction_loss", "contact_loss"})
    EXPECT_NEAR(value(*two, column), value(*one, column), 1e-3 * energy) << column;
}
INSTANTIATE_TEST_SUITE_P(Sweep, PartlyOverlappingCracks,
                         testing::Values(Case{.shift = 0.27, .more = {{.from = -0.13}}},
                                         Case{.shape_functions = "linear", .shift = 0.27, .more = {{.to = 0.13}}},
                                         Case{.shape_functions = "bspline", .shift = 0.27, .more = {{.from = -0.13}}},
                                         Case{.degrees = 30, .more = {{.reversed = true, .from = -0.4, .to = 0.21}}}));

/// Only opposite corners of two crossing cracks hold material: their signatures differ by both cracks, and they meet all the same.
class OppositeCorners : public testing::TestWithParam<const char*> {};
TEST_P(OppositeCorners, Meet) {
  const auto corners = [](const char* law) {
    return fmt::format(R"(
[grid]
origin = [-1, -1]
size = [2, 2]
cell = {}
[time]
end = 0.012
courant = 0.4
[method]
shape_functions = "{}"
[[material]]
name = "m"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "one"
material = "m"
shape = {{ kind = "rectangle", low = [-0.4, -0.4], high = [0, 0] }}
velocity = [1, 1]
[[body]]
name = "two"
material = "m"
shape = {{ kind = "rectangle", low = [0, 0], high = [0.4, 0.4] }}
velocity = [-1, -1]
[[crack]]
points = [[-0.9, 0], [0.9, 0]]
contact = {{ law = "{}" }}
fixed = true
[[crack]]
points = [[0, 0.9], [0, -0.9]]
contact = {{ law = "none" }}
fixed = true
)",
                       h, GetParam(), law);
  };
  const auto speed = [](Simulation& s) {
    const PointFrame frame = s.particles({"velocity"});
    const auto &v = field(frame, "velocity").values, &body = field(frame, "body").values;
    double sum = 0, count = 0;
    for (std::size_t p = 0; p < body.size(); ++p) {
      if (body[p] == 0) sum += v[3 * p + 1], ++count;
    }
    return sum / count;
  };
  const auto meet = make(corners("frictionless")), pass = make(corners("none"));
  run(*meet);
  run(*pass);
  // The law of the level crack alone acts, along y. In the time of a quarter of a cell's way the node at the corner has taken 12 %.
  EXPECT_LT(speed(*meet), 0.95);        // m/s
  EXPECT_NEAR(speed(*pass), 1, 1e-12);  // m/s
}
INSTANTIATE_TEST_SUITE_P(Shapes, OppositeCorners, testing::Values("linear", "gimp", "bspline"));

}  // namespace
}  // namespace crampon::test
