/// Material velocity fields: what must not matter, and what contact between several materials must keep.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "run_case.hpp"
#include "verification/four_bodies.hpp"

namespace crampon::test {
namespace {

struct BondedCase {
  int cracks;
  const char* shape_functions;
  const char* stress_update;
  const char* scheme;
};
void PrintTo(const BondedCase& c, std::ostream* out) {
  *out << c.cracks << " cracks, " << c.shape_functions << ", " << c.stress_update << ", " << c.scheme;
}
class BondedMaterials : public testing::TestWithParam<BondedCase> {};

/// Validation row 2: four bonded velocity fields, each cut by up to three crossing bonded cracks, are one.
TEST_P(BondedMaterials, EqualOneField) {
  const BondedCase& c = GetParam();
  const std::string method = fmt::format("shape_functions = \"{}\"\nstress_update = \"{}\"", c.shape_functions, c.stress_update);
  const std::string contact = fmt::format("default = {{ law = \"bonded\" }}\nscheme = \"{}\"", c.scheme);
  const auto parted = make(four_bodies(contact, method, c.cracks, "{ law = \"bonded\" }"));
  const auto whole = make(four_bodies("", method, 0, ""), {"contact.fields=\"single\""});
  double worst = 0;
  while (!whole->finished()) {
    parted->step(HUGE_VAL);
    whole->step(HUGE_VAL);
    if (whole->steps_done() % 10 != 0) continue;
    const PointFrame a = parted->particles(), b = whole->particles();
    for (const char* name : {"velocity", "displacement", "stress"}) {
      worst = std::fmax(worst, difference(field(a, name).values, field(b, name).values) / largest(field(b, name).values));
    }
  }
  EXPECT_LT(worst, 1e-12);  // round-off: fields are summed one by one instead of together
}
INSTANTIATE_TEST_SUITE_P(Fields, BondedMaterials,
                         testing::Values(BondedCase{0, "linear", "usavg", "consistent"}, BondedCase{1, "gimp", "usavg", "consistent"},
                                         BondedCase{2, "linear", "usavg", "literal"}, BondedCase{3, "bspline", "musl", "consistent"},
                                         BondedCase{2, "gimp", "usf", "consistent"}, BondedCase{3, "linear", "usavg", "consistent"}));

/// A law with memory where there is nothing to meet.
TEST(OneField, NeedsNoMemoryOfContact) {
  for (const char* law :
       {"{ law = \"slip_weakening\", friction = 0.1, static_friction = 0.5, distance = 0.001 }",
        "{ law = \"interface\", tension = 1e6, compression = 1e6, tangential = 1e6, normal_strength = 10, friction = 0.1 }"}) {
    const auto simulation = make(four_bodies("", "", 0, ""), {"contact.fields=\"single\"", std::string("contact.default=") + law});
    for (int k = 0; k < 3; ++k) simulation->step(HUGE_VAL);
    EXPECT_EQ(simulation->steps_done(), 3);
  }
}

void expect_refused(const std::string& text, const std::string& why) {
  try {
    make(text);
    ADD_FAILURE() << "taken: " << why;
  } catch (const InputError& error) {
    ASSERT_FALSE(error.diagnostics().empty());
    EXPECT_NE(error.diagnostics()[0].text().find(why), std::string::npos) << error.diagnostics()[0].text();
  }
}

/// What contact could not do right is refused.
TEST(ContactInput, IsRefusedWhereItCannotHold) {
  const std::string floor = "[[wall]]\nname = \"floor\"\npoint = [0, 0.01]\nnormal = [0, 1]\n";
  const std::string springs = "default = { law = \"interface\", tension = 1e6, compression = 1e6, tangential = 1e6 }";
  expect_refused(four_bodies(springs, "", 0, "", floor), "a wall has no displacement");
  const std::string finer =
      "[[body]]\nname = \"fine\"\nmaterial = \"soft\"\nfield = \"left\"\nparticles_per_cell = 3\n"
      "shape = { kind = \"rectangle\", low = [0.02, 0.02], high = [0.05, 0.05] }\n";
  expect_refused(four_bodies("", "", 0, "", finer), "share a velocity field but not their particles_per_cell");
}

struct ContactCase {
  const char* contact;
  const char* shape_functions;
  int cracks;
};
void PrintTo(const ContactCase& c, std::ostream* out) { *out << c.contact << ", " << c.shape_functions << ", " << c.cracks << " cracks"; }
class SeveralMaterials : public testing::TestWithParam<ContactCase> {};

/// Up to four materials at a node, with friction, in every way that contact is found and solved.
TEST_P(SeveralMaterials, KeepMomentumAndEnergy) {
  const ContactCase& c = GetParam();
  const auto simulation =
      make(four_bodies(fmt::format("default = {{ law = \"coulomb\", friction = 0.3 }}\n{}", c.contact),
                       fmt::format("shape_functions = \"{}\"", c.shape_functions), c.cracks, "{ law = \"coulomb\", friction = 0.2 }"));
  const double x = value(*simulation, "momentum_x"), y = value(*simulation, "momentum_y"), energy = value(*simulation, "total_energy");
  double highest = 0;
  run(*simulation, [&](Simulation& s) { highest = std::fmax(highest, value(s, "total_energy")); });
  // 60 steps of sums over 1300 particles of 60 kg m/s in all: round-off stays below 1e-12 of that.
  EXPECT_NEAR(value(*simulation, "momentum_x"), x, 1e-12 * 60);
  EXPECT_NEAR(value(*simulation, "momentum_y"), y, 1e-12 * 60);
  RecordProperty("energy_highest", fmt::format("{:.5f}", highest / energy));
  RecordProperty("energy_end", fmt::format("{:.5f}", value(*simulation, "total_energy") / energy));
  RecordProperty("closure", fmt::format("{:.2e}", value(*simulation, "energy_closure") / energy));
  RecordProperty("friction", fmt::format("{:.5f}", value(*simulation, "friction_loss") / energy));
  const bool literal = std::string(c.contact).find("literal") != std::string::npos;
  EXPECT_LE(highest, (literal ? 1.05 : 1.002) * energy);  // docs/theory/contact.md: the papers' scheme may gain energy
}
INSTANTIATE_TEST_SUITE_P(
    Contact, SeveralMaterials,
    testing::Values(ContactCase{"", "linear", 0}, ContactCase{"", "gimp", 2}, ContactCase{"", "bspline", 1},
                    ContactCase{"several_materials = \"virtual\"", "linear", 0}, ContactCase{"several_materials = \"virtual\"", "gimp", 2},
                    ContactCase{"scheme = \"literal\"", "linear", 1}, ContactCase{"detection = \"position\"", "gimp", 2},
                    ContactCase{"detection = \"regression\"", "linear", 2}, ContactCase{"position_cutoff = 0.8", "gimp", 0},
                    ContactCase{"scheme = \"literal\"\nseveral_materials = \"virtual\"\npairs = \"sequential\"", "gimp", 1},
                    ContactCase{"normal = \"largest_gradient\"", "linear", 0},
                    ContactCase{"normal = \"average_gradient\"\nmaterial_detection = \"regression\"", "gimp", 1},
                    ContactCase{"normal = \"linear_regression\"\nmaterial_detection = \"volume\"", "linear", 0},
                    ContactCase{"normal = \"more_volume\"\nmaterial_detection = \"displacement\"", "bspline", 0}));

class Everything : public testing::TestWithParam<const char*> {};

TEST_P(Everything, IsTheSameToTheBitForAnyNumberOfThreads) {
  std::uint64_t one = 0;
  for (const int threads : {1, 2, 3, 5}) {
    const auto simulation = make(everything(GetParam()), {}, threads);
    std::map<std::string, double> largest;
    run(*simulation, [&](Simulation& s) {
      for (const char* name :
           {"friction_loss", "reaction_x.ram", "torque_z.ram", "reaction_x.clamp", "reaction_y.floor", "cohesive_energy"})
        largest[name] = std::fmax(largest[name], std::fabs(value(s, name)));
    });
    if (threads == 1) {
      one = simulation->state_hash();
      const double energy = value(*simulation, "total_energy");
      RecordProperty("closure", fmt::format("{:.2e}", value(*simulation, "energy_closure") / energy));
      EXPECT_LT(std::fabs(value(*simulation, "energy_closure")), 0.05 * energy);
      // All of it takes part.
      for (const auto& [name, most] : largest) EXPECT_GT(most, 0) << name;
    } else {
      EXPECT_EQ(simulation->state_hash(), one) << threads << " threads";
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Shapes, Everything, testing::ValuesIn(all_shape_functions()));

/// Blocks in space that meet obliquely on a rigid floor: momentum across, energy, and the floor's reaction.
TEST(MaterialsInSpace, CollideOnAFloor) {
  for (const char* floor : {"[[wall]]\nname = \"floor\"\nkind = \"half_space\"\npoint = [0, 0, 0.04]\nnormal = [0, 0, 1]\n",
                            "[[rigid]]\nname = \"floor\"\nshape = { kind = \"box\", low = [0, 0, 0], high = [0.32, 0.2, 0.04] }\n"}) {
    const auto simulation = make(std::string(R"in(
analysis = "three_dimensional"
[grid]
origin = [0, 0, 0]
size = [0.32, 0.2, 0.2]
cell = 0.02
[time]
steps = 80
courant = 0.3
[method]
shape_functions = "gimp"
[contact]
fields = "bodies"
default = { law = "coulomb", friction = 0.3 }
[[material]]
name = "soft"
law = "neo_hookean"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "a"
material = "soft"
shape = { kind = "box", low = [0.06, 0.06, 0.06], high = [0.14, 0.14, 0.12] }
velocity = [2, 0.5, -2]
[[body]]
name = "b"
material = "soft"
shape = { kind = "sphere", centre = [0.19, 0.1, 0.1], radius = 0.041 }
velocity = [-2, -0.5, -2]
)in") + floor);
    const double energy = value(*simulation, "total_energy"), z = value(*simulation, "momentum_z");
    double impulse = 0, time = 0, highest = 0;
    run(*simulation, [&](Simulation& s) {
      impulse += value(s, "reaction_z.floor") * (s.time() - time);
      time = s.time();
      highest = std::fmax(highest, value(s, "total_energy"));
    });
    // The floor's reaction is all that changes the momentum normal to it; sums over 80 steps.
    EXPECT_NEAR(value(*simulation, "momentum_z") - z, impulse, 1e-11 * std::fabs(z));
    EXPECT_GT(impulse, 0.1 * std::fabs(z));
    EXPECT_LE(highest, 1.002 * energy);
    EXPECT_LT(std::fabs(value(*simulation, "energy_closure")), 0.02 * energy);
    RecordProperty("closure", fmt::format("{:.2e}", value(*simulation, "energy_closure") / energy));
  }
}

}  // namespace
}  // namespace crampon::test
