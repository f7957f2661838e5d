/// Contact over whole runs: it must not make energy, must not lose much of it, keeps momentum, keeps faces apart, and drags as Coulomb says.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double h = 0.01;  // m, cell

struct Impact {
  const char* name;
  const char* geometry;  ///< body with its velocity, and the points of its cracks
  std::vector<const char*> cracks;
};

/// One body cut from edge to edge; its parts run into each other at .5 m/s, the wave speed being 37 m/s. 22 ms: they meet, are pressed
/// together for about 10 ms while waves run to their ends and back, and part. The ends of the oblique cut slide on each other.
const Impact halves{"halves",
                    R"in(shape = { kind = "rectangle", low = [0.1, 0.15], high = [0.5, 0.25] }
velocity = [{ expression = "if(x < 0.31, 0.5, -0.5)" }, 0])in",
                    {"[0.31, 0.1], [0.31, 0.3]"}};
const Impact oblique{"oblique_halves",
                     R"in(shape = { kind = "rectangle", low = [0.1, 0.15], high = [0.5, 0.25] }
velocity = [{ expression = "if(x - 0.313 < 0.25*(y - 0.2), 0.5, -0.5)" }, 0])in",
                     {"[0.288, 0.1], [0.338, 0.3]"}};
/// A square that breathes and shears with two cracks that cross in it: four faces open, close and slide at the crossing.
const Impact crossing{"crossing_cracks",
                      R"in(shape = { kind = "rectangle", low = [0.2, 0.1], high = [0.4, 0.3] }
velocity = [{ expression = "-0.5*sin(8*(x - 0.3))" }, { expression = "-0.4*sin(8*(y - 0.2)) + 0.3*sin(10*(x - 0.3))" }])in",
                      {"[0.2431, 0.1523], [0.3612, 0.2571]", "[0.2513, 0.2612], [0.3571, 0.1417]"}};

struct ImpactCase {
  const Impact* impact;
  double friction;
  const char* shape_functions;
  double courant = 0.3;
  const char* update = "usavg";
};
void PrintTo(const ImpactCase& c, std::ostream* out) {
  *out << c.impact->name << ", friction " << c.friction << ", " << c.shape_functions << ", Courant number " << c.courant << ", "
       << c.update;
}
std::string name_of(const testing::TestParamInfo<ImpactCase>& info) {
  return fmt::format("{}_{}_{}_courant_{:02.0f}_{}", info.param.impact->name, info.param.friction > 0 ? "friction" : "frictionless",
                     info.param.shape_functions, 100 * info.param.courant, info.param.update);
}

constexpr const char* soft = R"([[material]]
name = "soft"
law = "elastic_small_strain"
E = "1 MPa"
nu = 0.3
density = "1 g/cm3"
)";

std::string input(const ImpactCase& c, const char* scheme) {
  std::string text = fmt::format(R"(
[grid]
origin = [0, 0]
size = [0.6, 0.4]
cell = {}
[time]
end = "22 ms"
courant = {}
[method]
shape_functions = "{}"
stress_update = "{}"
[contact]
scheme = "{}"
{}[[body]]
name = "block"
material = "soft"
{}
)",
                                 h, c.courant, c.shape_functions, c.update, scheme, soft, c.impact->geometry);
  for (const char* points : c.impact->cracks) {
    text += fmt::format("[[crack]]\npoints = [{}]\ncontact = {}\n", points,
                        c.friction > 0 ? fmt::format("{{ law = \"coulomb\", friction = {} }}", c.friction) : "{ law = \"frictionless\" }");
  }
  return text;
}

struct Outcome {
  double highest = 1, lowest = 1, end = 1;   ///< energy over that at the start
  double momentum_change = 0, momentum = 0;  ///< kg m/s; the sum of all particles' magnitudes
  double deepest = 0, widest = 0;            ///< opening, m
  double contact_loss = 0, closure = 0;      ///< over the energy at the start; the loss with that by friction
};

Outcome collide(const ImpactCase& c, const char* scheme) {
  const auto simulation = make(input(c, scheme));
  Outcome o;
  const PointFrame start = simulation->particles({"mass", "velocity"});
  for (std::size_t p = 0; p < start.positions.size() / 3; ++p) {
    const auto& v = field(start, "velocity").values;
    o.momentum += field(start, "mass").values[p] * std::hypot(v[3 * p], v[3 * p + 1]);
  }
  const double energy = value(*simulation, "total_energy"), x = value(*simulation, "momentum_x"), y = value(*simulation, "momentum_y");
  run(*simulation, [&](Simulation& s) {
    o.end = value(s, "total_energy") / energy;
    o.highest = std::fmax(o.highest, o.end);
    o.lowest = std::fmin(o.lowest, o.end);
    o.momentum_change = std::fmax(o.momentum_change, std::hypot(value(s, "momentum_x") - x, value(s, "momentum_y") - y));
    for (std::size_t k = 1; k <= c.impact->cracks.size(); ++k) {
      o.deepest = std::fmin(o.deepest, value(s, fmt::format("opening_min.crack{}", k)));
      o.widest = std::fmax(o.widest, value(s, fmt::format("opening_max.crack{}", k)));
    }
  });
  o.contact_loss = (value(*simulation, "contact_loss") + value(*simulation, "friction_loss")) / energy;
  o.closure = value(*simulation, "energy_closure") / energy;
  return o;
}

class ContactEnergy : public testing::TestWithParam<ImpactCase> {};

TEST_P(ContactEnergy, NeitherGrowsNorIsLost) {
  const Outcome o = collide(GetParam(), "consistent"), literal = collide(GetParam(), "literal");
  // docs/theory/contact.md, energy: above, USAVG's own oscillation; below, the inelastic onset of contact in cells of this
  // size, and what friction takes (measured: at most .7 % without friction and 4.7 % with it).
  // MUSL's stress is half a step off, and energy with it: 1 to 2 % to and fro here.
  const double swing = std::string(GetParam().update) == "musl" ? 0.025 : 0;
  EXPECT_LE(o.highest, 1.002 + swing);
  EXPECT_GE(o.lowest, 0.94);
  // Round-off of 270 steps.
  EXPECT_LT(o.momentum_change, 1e-12 * o.momentum);
  EXPECT_LT(literal.momentum_change, 1e-12 * o.momentum);
  EXPECT_GE(o.deepest, -0.05 * h);
  // Something has happened: faces that were closed at the start have opened.
  EXPECT_GT(o.widest, 0.1 * h);
  // What the history calls lost in contact is what the energy lacks. The balance (docs/theory/contact.md, energy) leaves small terms:
  // measured .13 %.
  EXPECT_NEAR(o.closure, 0, 0.005 + swing);
  EXPECT_NEAR(o.contact_loss, 1 - o.end, 0.005 + swing);
  RecordProperty("closure", fmt::format("{:.2e}", o.closure));
  RecordProperty("energy_highest", fmt::format("{:.4f}", o.highest));
  RecordProperty("energy_end", fmt::format("{:.4f}", o.end));
  RecordProperty("energy_highest_literal", fmt::format("{:.4f}", literal.highest));
  RecordProperty("energy_end_literal", fmt::format("{:.4f}", literal.end));
  RecordProperty("deepest_opening_in_cells", fmt::format("{:.2e}", o.deepest / h));
}

std::vector<ImpactCase> cases() {
  std::vector<ImpactCase> list;
  for (const Impact* impact : {&halves, &oblique, &crossing}) {
    for (const double friction : {0., 0.3}) {
      for (const char* shape : {"linear", "gimp", "bspline"}) {
        for (const double courant : {0.15, 0.3, 0.6}) list.push_back({impact, friction, shape, courant});
      }
    }
  }
  // Where bodies meet before any force acts, round-off must not decide which nodes touch.
  for (const Impact* impact : {&halves, &oblique, &crossing}) list.push_back({impact, 0, "linear", 0.3, "musl"});
  return list;
}
INSTANTIATE_TEST_SUITE_P(Impacts, ContactEnergy, testing::ValuesIn(cases_for(Runs::every, cases())), name_of);
INSTANTIATE_TEST_SUITE_P(ImpactsFull, ContactEnergy, testing::ValuesIn(cases_for(Runs::full, cases())), name_of);

/// The same halves: after the collision each goes back with the speed of the other, for the halves are of one matter.
TEST(ContactImpact, HalvesPartAgain) {
  const auto simulation = make(input({&halves, 0, "linear"}, "consistent"));
  run(*simulation);
  const PointFrame end = simulation->particles({"velocity", "displacement", "mass"});
  double momentum[2] = {}, mass[2] = {};
  for (std::size_t p = 0; p < end.positions.size() / 3; ++p) {
    const int side = end.positions[3 * p] - field(end, "displacement").values[3 * p] > 0.31;
    mass[side] += field(end, "mass").values[p];
    momentum[side] += field(end, "mass").values[p] * field(end, "velocity").values[3 * p];
  }
  // A long bar of 21 cells on one of 19: all that is not kept in vibrations is given back. Wrong in kind: sticking, passing, speeding up.
  EXPECT_LT(momentum[0] / mass[0], -0.3);
  EXPECT_GT(momentum[1] / mass[1], 0.3);
  EXPECT_LT(std::fabs(momentum[0] / mass[0]), 0.55);
}

struct DragCase {
  double friction;
  const char* shape_functions;
};
class Drag : public testing::TestWithParam<DragCase> {};

/// A block on a block, pressed together by .1 mm in 200 and then drawn slowly across it, damped: the floor feels the friction times the load. The load is
/// light, for a tilt of the faces by 1e-3 would already change the ratio by as much.
TEST_P(Drag, GivesCoulombsRatio) {
  const DragCase& c = GetParam();
  const auto simulation = make(fmt::format(R"(
[grid]
origin = [-0.1, 0]
size = [0.6, 0.24]
cell = {}
[time]
end = "100 ms"
courant = 0.3
[method]
shape_functions = "{}"
damping = 300
{}[[body]]
name = "block"
material = "soft"
shape = {{ kind = "rectangle", low = [0.1, 0], high = [0.3, 0.2] }}
[[crack]]
name = "cut"
points = [[0.05, 0.103], [0.35, 0.103]]
contact = {{ law = "coulomb", friction = {} }}
[[boundary]]
name = "floor"
region = {{ kind = "line", from = [-0.1, 0], to = [0.5, 0] }}
vx = 0
vy = 0
[[boundary]]
name = "grip"
region = {{ kind = "line", from = [-0.1, 0.2], to = [0.5, 0.2] }}
vx = {{ times = [0, 0.02, 0.04, 0.1], values = [0, 0, 0.02, 0.02] }}
vy = {{ times = [0, 0.01, 0.011, 0.1], values = [-0.01, -0.01, 0, 0] }}
)",
                                           h, c.shape_functions, soft, c.friction));
  double deepest = 0, tangential = 0, normal = 0, slid_before = 0;
  run(*simulation, [&](Simulation& s) {
    deepest = std::fmin(deepest, value(s, "opening_min.cut"));
    if (s.time() < 0.08) {
      slid_before = value(s, "sliding_max.cut");
      return;
    }
    // The floor holds the lower block, which is at rest: what acts on it is what acts on the cut.
    tangential -= value(s, "reaction_x.floor");
    normal += value(s, "reaction_y.floor");
  });
  EXPECT_GT(normal, 0);
  EXPECT_NEAR(tangential / normal, c.friction, 0.01 * c.friction);
  // It did slide all the while, as fast as it is drawn, less a few per cent that the blocks shear.
  EXPECT_NEAR(value(*simulation, "sliding_max.cut") - slid_before, 0.02 * 0.02, 0.2 * 0.02 * 0.02);
  EXPECT_GE(deepest, -0.05 * h);
  RecordProperty("ratio", fmt::format("{:.4f}", tangential / normal));
}
INSTANTIATE_TEST_SUITE_P(Coulomb, Drag,
                         testing::Values(DragCase{0.3, "linear"}, DragCase{0.6, "linear"}, DragCase{0.3, "gimp"}, DragCase{0.3, "bspline"}),
                         [](const auto& of) { return fmt::format("{}_{:.0f}", of.param.shape_functions, 10 * of.param.friction); });

}  // namespace
}  // namespace crampon::test
