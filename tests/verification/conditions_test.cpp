/// Conditions that meet: boundaries that follow each other in time or lie on each other, body force and mirror images at symmetry planes,
/// and contradictions between them.

#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

/// A bar of 2 x 4 cells that something pulls.
const std::string bar = R"(
[grid]
origin = [0, 0]
size = ["8 mm", "8 mm"]
cell = "1 mm"
[time]
steps = 40
step = "0.3 us"
[[material]]
name = "m"
law = "elastic_small_strain"
E = "1 GPa"
nu = 0.3
density = 1000
[[body]]
name = "b"
material = "m"
shape = { kind = "rectangle", low = ["3 mm", "2 mm"], high = ["5 mm", "6 mm"] }
)";

std::string pulled(const std::string& name, const std::string& value, const std::string& more = "") {
  return "[[boundary]]\nname = \"" + name +
         "\"\nregion = { kind = \"line\", from = [0, \"2 mm\"], to = [\"8 mm\", \"2 mm\"] }\nvy = " + value + "\n" + more;
}

void expect_equal_runs(const std::string& a, const std::string& b, double relative) {
  const auto one = make(a), two = make(b);
  run(*one);
  run(*two);
  const PointFrame first = one->particles(), second = two->particles();
  for (const char* name : {"velocity", "stress"}) {
    const Numbers& expected = field(first, name).values;
    ASSERT_GT(largest(expected), 0);
    EXPECT_LE(difference(field(second, name).values, expected), relative * largest(expected)) << name;
  }
}

TEST(Conditions, OneMayHandOverToTheNext) {
  // 20 steps of 0.3 us each; V_old is p_int/m only in the first step in which the *component* is prescribed (docs/theory/step.md, boundary
  // values).
  const std::string ramp = "{ expression = \"2e5*t\", unit = \"m/s\" }";
  for (const char* force : {"incremental", "n13", "zero"}) {
    const std::string method = std::string("[method]\nfixed_force = \"") + force + "\"\n";
    expect_equal_runs(bar + method + pulled("all", ramp),
                      bar + method + pulled("first", ramp, "end = \"6 us\"\n") + pulled("then", ramp, "start = \"6 us\"\n"), 0);
  }
}

/// Where the velocity jumps at the handover, nodes are taken from the old one to the new by a force, as if one condition said both.
TEST(Conditions, AHandoverMayJump) {
  for (const char* force : {"incremental", "n13", "zero"}) {
    const std::string method = std::string("[method]\nfixed_force = \"") + force + "\"\n";
    expect_equal_runs(bar + method + pulled("all", "{ expression = \"if(t < 6.01e-6, 0, 0.5)\", unit = \"m/s\" }"),
                      bar + method + pulled("first", "0", "end = \"6 us\"\n") + pulled("then", "0.5", "start = \"6 us\"\n"), 0);
  }
}

TEST(Conditions, TheLastActiveOneHolds) {
  for (const char* force : {"incremental", "n13"}) {
    const std::string method = std::string("[method]\nfixed_force = \"") + force + "\"\n";
    // The one in the middle never acts, and the first is overruled all the time in the part where the last one is.
    const std::string part =
        "[[boundary]]\nname = \"last\"\nregion = { kind = \"line\", from = [0, \"2 mm\"], to = [\"5 mm\", \"2 mm\"] }\nvy = 1\n";
    const std::string rest =
        "[[boundary]]\nname = \"rest\"\nregion = { kind = \"line\", from = [\"5.5 mm\", \"2 mm\"], to = [\"8 mm\", \"2 mm\"] }\nvy = 2\n";
    expect_equal_runs(bar + method + rest + part, bar + method + pulled("first", "2") + pulled("never", "2", "start = 1\n") + part, 0);
  }
}

TEST(Conditions, ContradictionsAreRefused) {
  const auto refused = [](const std::string& text) -> std::string {
    try {
      make(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(
      refused(bar + pulled("a", "0") + pulled("b", "1")).find("boundary[0]: \"a\" prescribes vy = 0 m/s where \"b\" prescribes 1 m/s"),
      std::string::npos);
  EXPECT_NE(refused(bar + pulled("a", "1") + "[[symmetry]]\nname = \"s\"\naxis = \"y\"\nat = \"2 mm\"\nside = \"above\"\n")
                .find("material stays on a symmetry plane"),
            std::string::npos);
  EXPECT_EQ(refused(bar + pulled("a", "1") + pulled("b", "1")), "") << "the same value twice";
  EXPECT_EQ(refused(bar + pulled("a", "0", "end = \"3 us\"\n") + pulled("b", "1", "start = \"3 us\"\n")), "") << "one after the other";
  EXPECT_EQ(refused(bar + pulled("a", "0") + pulled("b", "1", "start = \"3 us\"\n")), "") << "the first holds for a while";
  EXPECT_EQ(
      refused(bar + pulled("a", "0") + "[[boundary]]\nname = \"b\"\nregion = { kind = \"point\", at = [\"4 mm\", \"2 mm\"] }\nvy = 1\n"),
      "")
      << "a part that differs from the rest";
}

/// Mirrored mass carries mirrored force (conventions 29): gravity as a body force equals gravity as a force on every particle.
TEST(Conditions, BodyForceOnASymmetryPlane) {
  // Particles of 1/4 mm2 and 1 m: 2.5e-4 kg.
  const std::string on_each = "[[load]]\nname = \"w\"\nkind = \"force_each\"\nvalue = [0, \"-0.25 N\"]\n";
  const std::string floor = "[[symmetry]]\nname = \"s\"\naxis = \"y\"\nat = \"2 mm\"\nside = \"above\"\n";
  for (const char* shape : {"linear", "gimp", "bspline"}) {
    const std::string method = std::string("[method]\nshape_functions = \"") + shape + "\"\n";
    const std::string gravity = bar + floor + method + "body_force = [0, -1000]\n";
    expect_equal_runs(bar + floor + method + on_each, gravity, 1e-12);
    const auto weighed = make(gravity);
    run(*weighed);
    // Linear functions fold nothing: their account after a sudden load closes to 0.4 %, and that of the others is as good.
    EXPECT_LT(std::fabs(value(*weighed, "energy_closure")), 5e-3 * value(*weighed, "body_force_work")) << shape;
  }
}

/// What is prescribed is looked at before it does harm, and named.
TEST(Conditions, PrescribedValuesMustBeNumbers) {
  const std::string late = "{ expression = \"sqrt(1e-6-t)\" }";
  for (const auto& [input, name] : std::vector<std::pair<std::string, std::string>>{
           {bar + pulled("grip", late), "grip"},
           {bar + "[[wall]]\nname = \"punch\"\npoint = [0, 0]\nnormal = [0, 1]\nvelocity = [0, " + late + "]\n", "punch"},
           {bar + "[[wall]]\nname = \"wheel\"\nkind = \"ball\"\ncentre = [0, 0]\nradius = 0.001\nspin = " + late + "\n", "wheel"},
           {bar + "[[load]]\nname = \"p\"\nkind = \"total_force\"\nvalue = [" + late + ", 0]\n", "\"p\""},
           {bar + "[method]\nbody_force = [0, " + late + "]\n", "body force"},
           {bar + "[method]\ndamping = " + late + "\n", "damping"}}) {
    const auto simulation = make(input);
    try {
      run(*simulation);
      ADD_FAILURE() << name << " goes on with NaN";
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("not a number; correct the table or expression"), std::string::npos) << error.what();
    }
  }
}

TEST(Conditions, BodiesInsideWallsAreTold) {
  const auto notes = [](const std::string& law) {
    return make(bar + "[[wall]]\nname = \"plate\"\npoint = [0, \"5 mm\"]\nnormal = [0, 1]\n[contact]\ndefault = \"" + law + "\"\n")
        ->notes_at_start();
  };
  ASSERT_EQ(notes("frictionless").size(), 1u);
  EXPECT_NE(notes("frictionless")[0].find("16 particles begin more than a cell inside the wall \"plate\""), std::string::npos)
      << notes("frictionless")[0];
  EXPECT_TRUE(notes("none").empty());
}

TEST(Conditions, BadNumbersStopTheRun) {
  const std::string load =
      "[[load]]\nname = \"p\"\nkind = \"total_force\"\nvalue = [{ expression = \"if(t > 1e-6, 1e308, 0)\", unit = \"N\" }, 0]\n";  // an infinite acceleration
  for (const char* update : {"usl", "musl", "usf", "usavg"}) {
    for (const char* shape : {"linear", "gimp", "bspline"}) {
      const auto simulation = make(bar + load + "[method]\nstress_update = \"" + update + "\"\nshape_functions = \"" + shape + "\"\n");
      try {
        run(*simulation);
        ADD_FAILURE() << update << " " << shape << " goes on with NaN";
      } catch (const RunError& error) {
        EXPECT_NE(std::string(error.what()).find("not a number"), std::string::npos) << error.what();
      }
    }
  }
}

TEST(Conditions, ProbesTakeComponentsAndDerivedQuantities) {
  const auto probe = [](const std::string& quantity) {
    return "[[probe]]\nname = \"" + quantity + "\"\nquantity = \"" + quantity + "\"\npoint = [\"4 mm\", \"4 mm\"]\n";
  };
  const auto simulation = make(bar + pulled("a", "1") + probe("velocity") + probe("velocity_y") + probe("stress") + probe("von_mises"));
  run(*simulation);
  EXPECT_NE(value(*simulation, "velocity_y.velocity_y"), 0);
  EXPECT_EQ(value(*simulation, "velocity_y.velocity_y"), value(*simulation, "velocity.velocity_y"));
  const auto stress = [&](const char* part) { return value(*simulation, std::string("stress.stress_") + part); };
  const double a = stress("xx") - stress("yy"), b = stress("yy") - stress("zz"), c = stress("zz") - stress("xx"), s = stress("xy");
  EXPECT_NEAR(value(*simulation, "von_mises.von_mises"), std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * s * s), 1e-9 * std::fabs(a));
  try {
    make(bar + probe("velocit_y"));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("probe[0].quantity: no quantity \"velocit_y\"; did you mean"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace crampon::test
