/// What must not matter: the number of threads, bonded cracks, where the body lies, which way it is turned.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

/// Two blocks that collide across cracks, in every way the engine has: several blocks of cells, several velocity fields, contact, drift.
std::string colliding_blocks(const std::string& cracks, const std::string& method) {
  return fmt::format(R"(
analysis = "plane_strain"
[grid]
origin = [0, 0]
size = [0.4, 0.24]
cell = 0.01
[time]
steps = 60
courant = 0.4
[method]
{}
[[material]]
name = "soft"
law = "elastic_small_strain"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "left"
material = "soft"
shape = {{ kind = "rectangle", low = [0.05, 0.06], high = [0.2, 0.18] }}
velocity = [2, 0.3]
[[body]]
name = "right"
material = "soft"
shape = {{ kind = "disk", centre = [0.27, 0.125], radius = 0.063 }}
velocity = [-3, 0]
{})",
                     method, cracks);
}

std::string crack(const std::string& points, const std::string& law) {
  return fmt::format("[[crack]]\npoints = [{}]\ncontact = {}\n", points, law);
}

const char* three_crossing[3] = {"[0.081, 0.1213], [0.179, 0.1187]", "[0.1293, 0.075], [0.1307, 0.165]", "[0.09, 0.08], [0.17, 0.16]"};

class Threads : public testing::TestWithParam<const char*> {};

TEST_P(Threads, TheSameBitsForAnyNumber) {
  std::string cracks;
  for (const char* points : three_crossing) cracks += crack(points, "{ law = \"coulomb\", friction = 0.3 }");
  const std::string text = colliding_blocks(cracks, fmt::format("shape_functions = \"{}\"\ndamping = 3", GetParam()));
  std::uint64_t one = 0;
  for (const int threads : {1, 2, 3, 5}) {
    const auto simulation = make(text, {}, threads);
    run(*simulation);
    if (threads == 1) {
      one = simulation->state_hash();
    } else {
      EXPECT_EQ(simulation->state_hash(), one) << threads << " threads";
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Shapes, Threads, testing::ValuesIn(all_shape_functions()));

struct BondedCase {
  int cracks;
  const char* shape_functions;
  const char* stress_update;
  const char* scheme;
  int steps = 60;
};
void PrintTo(const BondedCase& c, std::ostream* out) {
  *out << c.cracks << " cracks, " << c.shape_functions << ", " << c.stress_update << ", " << c.scheme;
}
class Bonded : public testing::TestWithParam<BondedCase> {};

/// Validation row 2 for cracks: one, two and three crossing at a point.
TEST_P(Bonded, EqualsTheBodyWithoutCracks) {
  const BondedCase& c = GetParam();
  const std::string method = fmt::format("shape_functions = \"{}\"\nstress_update = \"{}\"\n[contact]\nscheme = \"{}\"", c.shape_functions,
                                         c.stress_update, c.scheme);
  std::string cracks;
  for (int k = 0; k < c.cracks; ++k) cracks += crack(three_crossing[k], "{ law = \"bonded\" }");
  const auto cracked = make(colliding_blocks(cracks, method)), whole = make(colliding_blocks("", method));
  double worst = 0;
  for (int step = 0; step < c.steps; ++step) {
    cracked->step(HUGE_VAL);
    whole->step(HUGE_VAL);
    if (step % 10 != 9) continue;
    const PointFrame a = cracked->particles(), b = whole->particles();
    for (const char* name : {"velocity", "displacement", "stress"}) {
      worst = std::fmax(worst, difference(field(a, name).values, field(b, name).values) / largest(field(b, name).values));
    }
  }
  EXPECT_LT(worst, 1e-12);  // round-off: fields are summed one by one instead of together
}
INSTANTIATE_TEST_SUITE_P(Cracks, Bonded,
                         testing::Values(BondedCase{1, "linear", "usavg", "consistent"}, BondedCase{2, "linear", "usavg", "consistent"},
                                         BondedCase{3, "linear", "usavg", "consistent"}, BondedCase{3, "linear", "musl", "literal"},
                                         BondedCase{2, "gimp", "usf", "consistent"}, BondedCase{3, "gimp", "usavg", "literal"},
                                         BondedCase{2, "linear", "usl", "consistent", 20} /* USL blows up after 33 steps */));
INSTANTIATE_TEST_SUITE_P(Shapes, Bonded, testing::ValuesIn(for_all_shape_functions<BondedCase>([](const char* shape) {
                           return std::vector<BondedCase>{{2, shape, "usavg", "consistent"}, {3, shape, "musl", "consistent"}};
                         })));

/// Momentum over contact, friction and crossings; there is no outer force.
TEST(Momentum, IsConservedByContact) {
  std::string cracks;
  for (const char* points : three_crossing) cracks += crack(points, "{ law = \"coulomb\", friction = 0.3 }");
  for (const char* scheme : {"consistent", "literal"}) {
    const auto simulation = make(colliding_blocks(cracks, fmt::format("shape_functions = \"gimp\"\n[contact]\nscheme = \"{}\"", scheme)));
    const double x = value(*simulation, "momentum_x"), y = value(*simulation, "momentum_y");
    run(*simulation);
    // 60 steps of sums over 1500 particles of 25 kg m/s in all: round-off stays below 1e-12 of that.
    EXPECT_NEAR(value(*simulation, "momentum_x"), x, 1e-12 * 40) << scheme;
    EXPECT_NEAR(value(*simulation, "momentum_y"), y, 1e-12 * 40) << scheme;
  }
}

/// A block with a crack, translated by whole cells and turned by 90 degrees.
std::string placed(double dx, double dy, bool turned, const char* shape_functions) {
  const auto point = [&](double x, double y) {
    return turned ? fmt::format("[{}, {}]", dx - y, dy + x) : fmt::format("[{}, {}]", dx + x, dy + y);
  };
  const std::string low = turned ? fmt::format("[{}, {}]", dx - 0.5, dy) : fmt::format("[{}, {}]", dx, dy);
  const std::string high = turned ? fmt::format("[{}, {}]", dx, dy + 0.75) : fmt::format("[{}, {}]", dx + 0.75, dy + 0.5);
  // The velocity field, in the body's own axes: shear that slides and closes the crack.
  const std::string u = "0.3*sin(3*Y)", w = "-0.4*(Y-0.25)*cos(2*X)";
  const auto in_axes = [&](std::string text) {
    const std::string X = turned ? fmt::format("(y-({}))", dy) : fmt::format("(x-({}))", dx),
                      Y = turned ? fmt::format("(({})-x)", dx) : fmt::format("(y-({}))", dy);
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != 'X' && text[i] != 'Y') continue;
      const std::string& r = text[i] == 'X' ? X : Y;
      text.replace(i, 1, r);
      i += r.size() - 1;
    }
    return text;
  };
  const std::string vx = turned ? "-(" + in_axes(w) + ")" : in_axes(u), vy = turned ? in_axes(u) : in_axes(w);
  return fmt::format(R"(
[grid]
origin = [-2, -2]
size = [4, 4]
cell = 0.0625
[time]
steps = 50
step = 4e-4
[method]
shape_functions = "{}"
[[material]]
name = "soft"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "block"
material = "soft"
shape = {{ kind = "rectangle", low = {}, high = {} }}
velocity = [{{ expression = "{}" }}, {{ expression = "{}" }}]
[[crack]]
points = [{}, {}]
contact = {{ law = "coulomb", friction = 0.2 }}
)",
                     shape_functions, low, high, vx, vy, point(0.11, 0.26), point(0.55, 0.24));
}

class Placed : public testing::TestWithParam<const char*> {};

TEST_P(Placed, TranslationByCellsChangesNothing) {
  const auto here = make(placed(0, 0, false, GetParam())), there = make(placed(0.5, -0.75, false, GetParam()));
  run(*here);
  run(*there);
  const PointFrame a = here->particles(), b = there->particles();
  for (const char* name : {"velocity", "displacement", "stress"}) {
    // Coordinates carry other round-off at another place: 1e-16 of 1 m against displacements of 5 mm and fifty steps.
    EXPECT_LT(difference(field(a, name).values, field(b, name).values), 1e-10 * largest(field(a, name).values)) << name;
  }
}

TEST_P(Placed, TurningByNinetyDegreesTurnsTheResult) {
  const auto upright = make(placed(0, 0, false, GetParam())), turned = make(placed(0, 0, true, GetParam()));
  run(*upright);
  run(*turned);
  const PointFrame a = upright->particles(), b = turned->particles();
  // Particles of the turned block are numbered along other axes: match by their places at the start.
  const auto start = [](const PointFrame& f, std::size_t i, int k) {
    return f.positions[3 * i + static_cast<std::size_t>(k)] - field(f, "displacement").values[3 * i + static_cast<std::size_t>(k)];
  };
  std::map<std::pair<long, long>, std::size_t> by_place;
  const std::size_t n = a.positions.size() / 3;
  for (std::size_t i = 0; i < n; ++i) by_place[{std::lround(start(b, i, 1) * 1e6), std::lround(-start(b, i, 0) * 1e6)}] = i;
  ASSERT_EQ(by_place.size(), n);
  const double speed = largest(field(a, "velocity").values), stress = largest(field(a, "stress").values);
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = by_place.find({std::lround(start(a, i, 0) * 1e6), std::lround(start(a, i, 1) * 1e6)});
    ASSERT_NE(at, by_place.end());
    const std::size_t j = at->second;
    const auto &va = field(a, "velocity").values, &vb = field(b, "velocity").values, &sa = field(a, "stress").values,
               &sb = field(b, "stress").values;
    EXPECT_NEAR(va[3 * i], vb[3 * j + 1], 1e-10 * speed);
    EXPECT_NEAR(va[3 * i + 1], -vb[3 * j], 1e-10 * speed);
    EXPECT_NEAR(sa[6 * i], sb[6 * j + 1], 1e-10 * stress);
    EXPECT_NEAR(sa[6 * i + 1], sb[6 * j], 1e-10 * stress);
    EXPECT_NEAR(sa[6 * i + 3], -sb[6 * j + 3], 1e-10 * stress);
  }
}
INSTANTIATE_TEST_SUITE_P(Shapes, Placed, testing::ValuesIn(all_shape_functions()));

}  // namespace
}  // namespace crampon::test
