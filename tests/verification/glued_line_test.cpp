/// Cracks with traction laws in bodies that turn, and lines that end at, beyond or before an edge.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

// A free disk of ten cells' radius turns, with a line across it that ends four cells inside.
struct Turn {
  const char* shape_functions;
  double degrees;  ///< of the line, from the x axis
  double turns;
  const char* law;
};
void PrintTo(const Turn& t, std::ostream* out) {
  *out << t.shape_functions << ", " << t.degrees << " degrees, " << t.turns << " turns, " << t.law;
}

constexpr double disk_cell = 0.0625, disk_spin = 0.16;

std::string turning_disk(const Turn& t, const std::string& traction) {
  const double x = 0.4 * std::cos(t.degrees * M_PI / 180), y = 0.4 * std::sin(t.degrees * M_PI / 180);
  return fmt::format(R"in(
[grid]
origin = [-1, -1]
size = [2, 2]
cell = {}
[time]
end = {:.17g}
courant = 0.4
[method]
shape_functions = "{}"
[[material]]
name = "m"
law = "elastic_large_rotation"
E = 1e5
nu = 0.3
density = 1000
[[body]]
name = "disk"
material = "m"
shape = {{ kind = "disk", centre = [0.01, 0.02], radius = 0.625 }}
spin = [{}]
[[crack]]
name = "glue"
points = [[{:.17g}, {:.17g}], [{:.17g}, {:.17g}]]
contact = "frictionless"
{}
)in",
                     disk_cell, t.turns * 2 * M_PI / disk_spin, t.shape_functions, disk_spin, 0.01 - x, 0.02 - y, 0.01 + x, 0.02 + y,
                     traction);
}

/// What the law may do, and did at most, to a disk that has turned.
struct TurnBounds {
  double spin_lost;   ///< of the spin that the disk with a bare crack has then
  double opened;      ///< cells: opening or slide where there is none
  double unbalanced;  ///< of its kinetic energy
};

/// A law costs no spin, opens nothing and keeps the balance; surface points stay beside the particles of the first rows.
void expect_free_turn(const Turn& t, const TurnBounds& bounds) {
  const auto without = make(turning_disk(t, ""));
  run(*without);
  const auto glued = make(turning_disk(t, fmt::format("traction = {}", t.law)));
  const PointFrame start = glued->particles();
  double opened = 0, unbalanced = 0;
  run(*glued, [&](Simulation& s) {
    for (const char* column : {"opening_max.glue", "sliding_max.glue"}) opened = std::fmax(opened, std::fabs(value(s, column)));
    unbalanced = std::fmax(unbalanced, std::fabs(value(s, "energy_closure")));
  });
  const double spin = value(*glued, "angular_momentum_z"), spin_without = value(*without, "angular_momentum_z");

  // Each surface point and the particle that was nearest to it, turned back by the mean turn of all particles.
  const PointFrame end = glued->particles();
  const CrackFrame crack = glued->cracks();
  double cosine = 0, sine = 0;
  const std::size_t n = start.positions.size() / 3;
  for (std::size_t p = 0; p < n; ++p) {
    const double a[2] = {start.positions[3 * p] - 0.01, start.positions[3 * p + 1] - 0.02};
    const double b[2] = {end.positions[3 * p] - 0.01, end.positions[3 * p + 1] - 0.02};
    cosine += a[0] * b[0] + a[1] * b[1];
    sine += a[0] * b[1] - a[1] * b[0];
  }
  const double length = std::hypot(cosine, sine), c = cosine / length, s = sine / length;
  double parted = 0;
  for (const auto* surface : {&crack.upper, &crack.lower}) {
    for (std::size_t v = 0; v < crack.original.size() / 3; ++v) {
      const double* X = &crack.original[3 * v];
      std::size_t nearest = 0;
      const auto distance = [&](std::size_t p) { return std::hypot(start.positions[3 * p] - X[0], start.positions[3 * p + 1] - X[1]); };
      for (std::size_t p = 1; p < n; ++p) nearest = distance(p) < distance(nearest) ? p : nearest;
      const double d[2] = {(*surface)[3 * v] - end.positions[3 * nearest], (*surface)[3 * v + 1] - end.positions[3 * nearest + 1]};
      const double D[2] = {X[0] - start.positions[3 * nearest], X[1] - start.positions[3 * nearest + 1]};
      parted = std::fmax(parted, std::hypot(c * d[0] + s * d[1] - D[0], -s * d[0] + c * d[1] - D[1]));
    }
  }
  testing::Test::RecordProperty("spin_lost_percent", fmt::format("{:.3f}", 100 * (1 - spin / spin_without)));
  testing::Test::RecordProperty("opened_cells", fmt::format("{:.2e}", opened / disk_cell));
  testing::Test::RecordProperty("parted_cells", fmt::format("{:.4f}", parted / disk_cell));
  testing::Test::RecordProperty("closure", fmt::format("{:.2e}", unbalanced / value(*without, "kinetic_energy")));
  EXPECT_NEAR(spin, spin_without, bounds.spin_lost * spin_without);
  EXPECT_LT(opened, bounds.opened * disk_cell);
  EXPECT_LT(parted, 0.05 * disk_cell);
  EXPECT_LT(unbalanced, bounds.unbalanced * value(*without, "kinetic_energy"));
}

class GlueInTurningDisk : public testing::TestWithParam<Turn> {};
class GlueInTurningDiskFull : public testing::TestWithParam<Turn> {};

TEST_P(GlueInTurningDisk, CostsNoSpinAndOpensNothing) { expect_free_turn(GetParam(), {0.005, 1e-3, 0.002}); }

/// A whole turn takes the disk 6000 waves over a cell.
TEST_P(GlueInTurningDiskFull, CostsNoSpinAndOpensNothing) { expect_free_turn(GetParam(), {0.005, 1e-3, 0.002}); }

constexpr const char* springs = "{ law = \"linear_elastic\", normal_stiffness = 1e7, shear_stiffness = 1e7 }";
constexpr const char* sawtooth =
    "{ law = \"mixed_mode\", normal = { curve = \"triangular\", strength = 1e4, toughness = 100, stiffness = 1e7 }, "
    "shear = { curve = \"triangular\", strength = 1e4, toughness = 100, stiffness = 1e7 } }";
INSTANTIATE_TEST_SUITE_P(Shapes, GlueInTurningDisk, testing::Values(Turn{"linear", 27, 0.125, springs}));
INSTANTIATE_TEST_SUITE_P(ShapesFull, GlueInTurningDisk, testing::ValuesIn(for_all_shape_functions<Turn>([](const char* shape) {
                           return std::vector<Turn>{{shape, 27, 0.125, springs}};
                         })));
INSTANTIATE_TEST_SUITE_P(Many, GlueInTurningDiskFull,
                         testing::Values(Turn{"linear", 27, 1, springs}, Turn{"gimp", 27, 1, springs}, Turn{"bspline", 27, 1, springs},
                                         Turn{"cubic_bspline", 27, 1, springs}, Turn{"gimp", 0, 1, springs},
                                         Turn{"gimp", 63, 1, sawtooth}));

// Two stiff halves, glued by a sawtooth of 50 J/m2 along 0.1 m, are pulled apart until nothing holds: 5 J, wherever the line ends.
struct Edge {
  const char* shape_functions;
  double beyond;  ///< cells: how far the line is drawn beyond both edges
  double shift;   ///< cells: where in a cell the edges lie
  double height;  ///< cells: of the line above a grid line
};
void PrintTo(const Edge& e, std::ostream* out) {
  *out << e.shape_functions << ", " << e.beyond << " beyond, edges at " << e.shift << ", line at " << e.height << " cells";
}

std::string glued_halves(const Edge& e, double stiffness) {
  const double h = 0.0125, left = e.shift * h, right = 0.1 + e.shift * h, y = e.height * h;
  return fmt::format(R"in(
[grid]
origin = [-0.05, -0.1]
size = [0.2, 0.2]
cell = {}
[time]
end = 0.02
courant = 0.4
[method]
shape_functions = "{}"
[[material]]
name = "m"
law = "elastic_small_strain"
E = 1e11
nu = 0
density = 1e6
[[body]]
name = "bar"
material = "m"
shape = {{ kind = "rectangle", low = [{}, -0.05], high = [{}, 0.05] }}
[[crack]]
name = "glue"
points = [[{:.17g}, {:.17g}], [{:.17g}, {:.17g}]]
contact = "frictionless"
traction = {{ law = "triangular", normal = {{ strength = "1 MPa", final_opening = "0.1 mm", stiffness = {:.17g} }}, shear = {{ strength = "1 MPa", final_opening = "0.1 mm", stiffness = {:.17g} }} }}
[[boundary]]
name = "low"
region = {{ kind = "rectangle", low = [-0.05, -0.1], high = [0.15, -0.05] }}
vy = 0
[[rigid]]
name = "top"
role = "boundary"
components = ["y"]
shape = {{ kind = "rectangle", low = [{}, 0.0375], high = [{}, 0.0625] }}
velocity = [0, {{ times = [0, 0.001], values = [0, 0.007] }}]
)in",
                     h, e.shape_functions, left, right, left - e.beyond * h, y, right + e.beyond * h, y, stiffness, stiffness, left, right);
}

class GlueToTheEdge : public testing::TestWithParam<Edge> {};
class GlueToTheEdgeFull : public GlueToTheEdge {};

void expect_whole_toughness(const Edge& e) {
  const auto simulation = make(glued_halves(e, 1e11));
  run(*simulation);
  testing::Test::RecordProperty("dissipated", fmt::format("{:.4f}", value(*simulation, "cohesive_loss_I")));
  EXPECT_NEAR(value(*simulation, "cohesive_loss_I"), 5, 0.025);
  EXPECT_NEAR(value(*simulation, "cohesive_loss_II"), 0, 0.005);
  EXPECT_EQ(value(*simulation, "cohesive_energy"), 0);  // nothing holds any more
}
TEST_P(GlueToTheEdge, TakesItsToughnessOverTheBody) { expect_whole_toughness(GetParam()); }
TEST_P(GlueToTheEdgeFull, TakesItsToughnessOverTheBody) { expect_whole_toughness(GetParam()); }

std::vector<Edge> edges() {
  std::vector<Edge> all;
  for (const char* shape : all_shape_functions()) {
    for (const double beyond : {0., 0.1, 0.5, 1., 2.}) {
      for (const double shift : {0., 0.25, 0.5, 0.62}) all.push_back({shape, beyond, shift, beyond == 0.5 ? 0. : 0.48});
    }
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(Shapes, GlueToTheEdge,
                         testing::Values(Edge{"linear", 0.5, 0, 0.48}, Edge{"gimp", 0, 0.25, 0}, Edge{"bspline", 2, 0.62, 0.2}));
INSTANTIATE_TEST_SUITE_P(Family, GlueToTheEdge, testing::ValuesIn(for_all_shape_functions<Edge>([](const char* shape) {
                           return std::vector<Edge>{{shape, 0, 0, 0.48}};
                         })));
INSTANTIATE_TEST_SUITE_P(Sweep, GlueToTheEdgeFull, testing::ValuesIn(edges()));

/// A law that would make a run endless is refused at once, with the place.
TEST(GlueThatIsStiff, IsRefusedWhenItForcesFarTooShortSteps) {
  try {
    make(glued_halves({"gimp", 0.5, 0, 0.48}, 1e20));
    FAIL() << "accepted";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("the traction law of the crack \"glue\" at ("), std::string::npos) << error.what();
  }
}

/// The announced step is the one that the law allows, and a note says so.
TEST(GlueThatIsStiff, AnnouncesTheStepThatTheLawForces) {
  const auto simulation = make(glued_halves({"gimp", 0.5, 0, 0.48}, 1e15));
  const double announced = simulation->size().time_step;
  const auto notes = simulation->notes_at_start();
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("the traction law of the crack \"glue\" asks for steps of") != std::string::npos;
  }));
  simulation->step(1);
  EXPECT_NEAR(simulation->time(), announced, 1e-12 * announced);
}

// Halves of a cut block fly apart.
class Cut : public testing::TestWithParam<Edge> {};

TEST_P(Cut, PartsTheBodyWhereverItEnds) {
  const Edge& e = GetParam();
  const double h = 0.1, left = e.shift * h, right = 1 + e.shift * h, y = e.height * h;
  const auto simulation = make(fmt::format(R"in(
[grid]
origin = [-0.5, -1]
size = [2, 2]
cell = 0.1
[time]
end = 0.5
courant = 0.4
[method]
shape_functions = "{}"
[[material]]
name = "m"
law = "elastic_small_strain"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "b"
material = "m"
shape = {{ kind = "rectangle", low = [{}, -0.5], high = [{}, 0.5] }}
velocity = [0, {{ expression = "if(y>{}, 0.2, -0.2)", unit = "m/s" }}]
[[crack]]
name = "cut"
points = [[{:.17g}, {:.17g}], [{:.17g}, {:.17g}]]
contact = "frictionless"
)in",
                                           e.shape_functions, left, right, y, left - e.beyond * h, y, right + e.beyond * h, y));
  const double start = value(*simulation, "kinetic_energy");
  run(*simulation);
  EXPECT_NEAR(value(*simulation, "kinetic_energy"), start, 1e-10 * start);
  EXPECT_LT(value(*simulation, "strain_energy"), 1e-10 * start);
}
INSTANTIATE_TEST_SUITE_P(
    Shapes, Cut, testing::ValuesIn(for_all_shape_functions<Edge>([](const char* shape) {
      return std::vector<Edge>{{shape, 0, 0, 0.2}, {shape, 0, 0.3, 0.2}, {shape, 0.4, 0.5, 0}, {shape, 0.4, 0, 0.2}, {shape, 1, 0, 0.5}};
    })));

}  // namespace
}  // namespace crampon::test
