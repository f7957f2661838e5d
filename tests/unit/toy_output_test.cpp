/// A further quantity of particles and a further observer of the history are one struct and one line: toys, added here, are known to output, probes, the
/// history, the reference page and the tests of both (output_reference_test.cpp is part of this program).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "crampon/run/crack_quantities.hpp"
#include "crampon/run/observers/registry.hpp"
#include "crampon/run/output_reference.hpp"
#include "crampon/run/quantities.hpp"
#include "run_case.hpp"

namespace crampon::test {
namespace {

const ParticleQuantity liveliness = {
    "toy_liveliness", "J/kg", 1, false, "kinetic energy per mass of a toy", "v.v/2", [](const ParticleView& p, double* out) {
      *out = 0.5 * dot(p.velocity, p.velocity);
    }};

/// The middle of the mass.
template <int Dim>
class ToyCentre final : public Observer<Dim> {
 public:
  static const auto& table() {
    static const std::vector<Column<Vec<Dim>>> all = {
        {{"toy_centre_AXIS", "m", "middle of the mass of a toy", "sum m x / sum m"},
         [](const Vec<Dim>& x, int axis) { return x[static_cast<std::size_t>(axis)]; },
         Axes::of_space},
    };
    return all;
  }
  void look(const Present<Dim>& now, Cells& cells) const override {
    const Particles<Dim>& particles = now.state.particles;
    Vec<Dim> sum;
    double mass = 0;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      if (particles.is_padding(p)) continue;
      sum += particles.present_position(p) * particles.mass(p);
      mass += particles.mass(p);
    }
    cells.add<Dim>(table(), sum * (1 / mass));
  }
};

/// The two lines; before main(), so that the tests of the families find them.
const bool joined = (add_quantity(liveliness), add_observer<ToyCentre>(), true);

std::string flying(int dimension) {
  const bool three = dimension == 3;
  return fmt::format(R"(
analysis = "{}"
[grid]
origin = {}
size = {}
cell = 0.1
[time]
steps = 5
step = 1e-3
{}[[body]]
name = "block"
material = "m"
shape = {}
velocity = {}
[[probe]]
name = "corner"
quantity = "toy_liveliness"
point = {}
[output]
quantities = ["toy_liveliness", "velocity"]
)",
                     three ? "three_dimensional" : "plane_strain", three ? "[0, 0, 0]" : "[0, 0]", three ? "[1, 1, 1]" : "[1, 1]",
                     material("elastic_large_rotation", 1e5),
                     three ? "{ kind = \"box\", low = [0.3, 0.3, 0.3], high = [0.5, 0.5, 0.5] }"
                           : "{ kind = \"rectangle\", low = [0.3, 0.3], high = [0.5, 0.5] }",
                     three ? "[3, 0, 4]" : "[3, 4]", three ? "[0.3, 0.3, 0.3]" : "[0.3, 0.3]");
}

TEST(ToyOutput, IsWrittenProbedAndWatched) {
  ASSERT_TRUE(joined);
  for (const int dimension : {2, 3}) {
    const auto simulation = make(flying(dimension));
    run(*simulation);
    const PointFrame frame = simulation->particles({"toy_liveliness"});
    // Free flight: velocities keep their values but for round-off of five steps.
    for (const double e : field(frame, "toy_liveliness").values) EXPECT_NEAR(e, 12.5, 1e-11) << dimension << "D";
    EXPECT_NEAR(value(*simulation, "corner.toy_liveliness"), 12.5, 1e-11);
    EXPECT_NEAR(value(*simulation, "toy_centre_x"), 0.4 + 3 * 5e-3, 1e-13);
    EXPECT_NEAR(value(*simulation, dimension == 3 ? "toy_centre_z" : "toy_centre_y"), 0.4 + 4 * 5e-3, 1e-13);
    const std::vector<std::string> names = simulation->particle_quantities();
    EXPECT_EQ(std::count(names.begin(), names.end(), "toy_liveliness"), 1);
  }
}

TEST(ToyOutput, IsReadAndCheckedAsAnyOther) {
  const Problem problem = read_problem_text(flying(2), "test.toml");
  EXPECT_EQ(problem.output.quantities.front(), "toy_liveliness");
  std::string text = flying(2);
  const std::string from = "quantity = \"toy_liveliness\"";
  text.replace(text.find(from), from.size(), "quantity = \"toy_livelines\"");
  EXPECT_THROW(make(text), InputError);
}

TEST(ToyOutput, IsOfferedByTheSchema) {
  const auto schema = nlohmann::json::parse(json_schema(output_words()))["properties"];
  const auto offers = [](const nlohmann::json& text, const char* word) {
    const auto& words = text["anyOf"][0]["enum"];
    return std::count(words.begin(), words.end(), word);
  };
  EXPECT_EQ(offers(schema["output"]["properties"]["quantities"]["anyOf"][1]["items"], "toy_liveliness"), 1);
  EXPECT_EQ(offers(schema["probe"]["items"]["properties"]["quantity"], "toy_liveliness"), 1);
  EXPECT_EQ(offers(schema["probe"]["items"]["properties"]["quantity"], "plastic_strain"), 1);
  const auto& expect = schema["expect"]["items"]["properties"];
  EXPECT_EQ(offers(expect["quantity"], "toy_liveliness"), 1);
  EXPECT_EQ(offers(expect["column"], "toy_centre_x"), 1);
  EXPECT_EQ(offers(expect["column"], "energy_closure"), 1);
  EXPECT_EQ(offers(expect["column"], "toy_centre_AXIS"), 0);
}

TEST(ToyOutput, StandsOnTheReferencePage) {
  const std::string page = output_reference_page();
  for (const char* text :
       {"`toy_liveliness`", "J/kg", "kinetic energy per mass of a toy", "toy_centre_AXIS", "middle of the mass of a toy"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

TEST(ToyOutput, MayNotTakeTheNameOfAnother) {
  EXPECT_THROW(add_quantity(liveliness), std::logic_error);
  EXPECT_THROW(add_quantity({"stress", "Pa", 6, false, "", "", {}}), std::logic_error);
}

/// All members of both families, these toys among them.
TEST(OutputFamilies, HaveNamesOfTheirOwnAndWords) {
  std::set<std::string> names;
  for (const ParticleQuantity& q : general_quantities()) {
    EXPECT_TRUE(names.insert(q.name).second) << q.name << " stands twice";
    EXPECT_FALSE(q.help.empty()) << q.name;
    EXPECT_FALSE(q.unit.empty()) << q.name;
    EXPECT_TRUE(q.components == 1 || q.components == 3 || q.components == 6) << q.name;
    EXPECT_TRUE(q.get) << q.name;
  }
  EXPECT_TRUE(names.contains("toy_liveliness"));
  std::set<std::string> columns;
  for (const ColumnDescription& c : describe_observers()) {
    EXPECT_TRUE(columns.insert(c.pattern).second) << c.pattern << " stands twice";
    EXPECT_FALSE(c.meaning.empty()) << c.pattern;
  }
  EXPECT_TRUE(columns.contains("toy_centre_AXIS"));
  EXPECT_EQ(make_observers<2>().size(), make_observers<3>().size());
  std::set<std::string> of_cracks;
  const std::string page = output_reference_page();
  for (const CrackQuantity& q : crack_quantities()) {
    EXPECT_TRUE(of_cracks.insert(q.name).second) << q.name << " stands twice";
    EXPECT_FALSE(q.meaning.empty()) << q.name;
    EXPECT_FALSE(q.unit.empty()) << q.name;
    EXPECT_NE(page.find("| `" + q.name + "` |"), std::string::npos) << q.name << " is not on the reference page";
  }
  EXPECT_TRUE(of_cracks.contains("opening") && of_cracks.contains("K_II") && of_cracks.contains("tip_status"));
}

}  // namespace
}  // namespace crampon::test
