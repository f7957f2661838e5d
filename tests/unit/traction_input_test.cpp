/// Traction laws as the input sees them: what is derived from what is given, and errors that say where they are.

#include <gtest/gtest.h>

#include "crampon/crack/traction/law.hpp"
#include "crampon/crack/traction/mixed_mode.hpp"
#include "crampon/crack/traction/none.hpp"
#include "crampon/crack/traction/pressure.hpp"
#include "crampon/input/record_reader.hpp"
#include "crampon/input/toml_source.hpp"

namespace crampon::test {
namespace {

struct Interface {
  TractionLawSpec traction;
};

const Declaration<Interface>& interface_declaration() {
  static const auto d = Declaration<Interface>("interface", "What carries a traction law.")
                            .one_of("traction", &Interface::traction, traction_laws, "the law");
  return d;
}

/// Reads `traction = <text>`.
TractionLawSpec read(const std::string& text) {
  Diagnostics diagnostics;
  Interface interface;
  const auto root = parse_toml("traction = " + text, "in.toml", diagnostics);
  ReadContext context{diagnostics, "."};
  if (root) read_record(context, interface_declaration(), *root, &interface, "");
  diagnostics.throw_if_any();
  return interface.traction;
}

std::string errors(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    std::string out;
    for (const Diagnostic& d : error.diagnostics()) out += d.text() + "\n";
    return out;
  }
  return "no error\n";
}

/// The same curve in both modes.
std::string both(const std::string& law, const std::string& curve) {
  return "{ law = \"" + law + "\", normal = { " + curve + " }, shear = { " + curve + " } }";
}

TEST(TractionInput, HasAllLawsOfTheFamily) {
  EXPECT_TRUE(Interface{}.traction.as<NoTraction>());
  for (const Alternative& law : traction_laws().alternatives()) {
    EXPECT_FALSE(law.record->help().empty());
    for (const Entry& entry : law.record->entries()) EXPECT_FALSE(entry.help.empty()) << law.name() << "." << entry.key;
  }
  EXPECT_TRUE(read("\"none\"").as<NoTraction>());
  EXPECT_TRUE(read("{ law = \"pressure\", pressure = \"1 bar\" }").as<PressureTraction>());
  EXPECT_EQ(read("{ law = \"pressure\", pressure = { expression = \"t\", unit = \"MPa\" } }").as<PressureTraction>()->pressure(2, {}), 2e6);
  EXPECT_EQ(read("{ law = \"linear_elastic\", normal_stiffness = \"100 MPa/mm\", shear_stiffness = 0 }")->largest_stiffness(), 1e11);
}

// Any two of strength, final opening and toughness give the same law.
TEST(TractionInput, TwoOfThreeDefineTheThird) {
  struct Law {
    std::string name, rest;
    double strength, final_opening;
  };
  const std::string knee = ", knee_stress = 2e6, knee_opening = 3e-5";
  for (const Law& l :
       {Law{"triangular", ", peak_opening = 1e-5", 5e6, 1e-4}, Law{"triangular", ", stiffness = 5e11", 5e6, 1e-4},
        Law{"trilinear", ", peak_opening = 1e-5" + knee, 5e6, 1e-4}, Law{"trilinear", ", stiffness = 5e11" + knee, 5e6, 1e-4},
        Law{"exponential", ", decay = 5, peak_opening = 1e-5", 5e6, 1e-4}, Law{"exponential", ", decay = 0.2, stiffness = 5e11", 5e6, 1e-4},
        Law{"cubic", "", 5e6, 1e-4}, Law{"elastic_brittle", "", 5e6, 1e-4}}) {
    SCOPED_TRACE(l.name + l.rest);
    const auto law = [&](const std::string& two) { return read(both(l.name, two + l.rest)); };
    const TractionLawSpec first = law("strength = 5e6, final_opening = 1e-4");
    const double G_c = first->toughness().normal, k = first->largest_stiffness();
    const std::string area = "toughness = " + std::to_string(G_c);  // six decimals of some hundred
    for (const std::string& two : {"strength = 5e6, " + area, "final_opening = 1e-4, " + area}) {
      EXPECT_NEAR(law(two)->toughness().shear, G_c, 1e-6);
      EXPECT_NEAR(law(two)->largest_stiffness(), k, 1e-7 * k);
      for (const double u : {0.3e-5, 2e-5, 6e-5, 0.99e-4}) {
        TractionHistory one, other;
        EXPECT_NEAR(update_traction(*first, {u, 0}, 0, {}, one).normal, update_traction(*law(two), {u, 0}, 0, {}, other).normal,
                    1e-6 * 5e6);
      }
    }
  }
}

TEST(TractionInput, MixedModeTakesACurveForEachMode) {
  const TractionLawSpec read_law = read(
      "{ law = \"mixed_mode\", normal = { curve = \"cubic\", strength = \"5 MPa\", toughness = \"300 J/m2\" }, "
      "shear = { curve = \"triangular\", strength = \"8 MPa\", toughness = \"0.9 N/mm\", stiffness = \"1 GPa/mm\" } }");
  ASSERT_TRUE(read_law.as<MixedModeTraction>());
  const MixedModeTraction& law = *read_law.as<MixedModeTraction>();
  EXPECT_EQ(std::get<CubicCurve>(law.normal).strength, 5e6);
  EXPECT_DOUBLE_EQ(law.toughness().normal, 300);
  EXPECT_DOUBLE_EQ(law.toughness().shear, 900);
  EXPECT_DOUBLE_EQ(std::get<TriangularCurve>(law.shear).peak_opening, 8e-6);
}

TEST(TractionInput, ErrorsSayWhere) {
  const auto in_normal = [](const std::string& law, const std::string& curve, const std::string& good) {
    return errors("{ law = \"" + law + "\", normal = { " + curve + " }, shear = { " + good + " } }");
  };
  const std::string triangle = "strength = 5e6, toughness = 250, stiffness = 5e11", bell = "strength = 5e6, toughness = 250";
  EXPECT_EQ(in_normal("triangular", triangle, triangle), "no error\n");
  EXPECT_EQ(in_normal("triangular", triangle + ", final_opening = 1e-4", triangle),
            "in.toml:1:61: traction.normal.toughness: strength, final_opening and toughness are all given (exactly two of strength, "
            "final_opening and toughness define the curve); remove one of them\n");
  EXPECT_EQ(in_normal("cubic", "final_opening = 1e-4", bell),
            "in.toml:1:40: traction.normal.final_opening: of the curve only final_opening is given (exactly two of strength, final_opening "
            "and toughness define the curve); add one of the others\n");
  EXPECT_EQ(in_normal("elastic_brittle", "", bell),
            "in.toml:1:48: traction.normal: the curve has no size (exactly two of strength, final_opening and toughness define the curve); "
            "add strength = ... and toughness = ...\n");
  EXPECT_EQ(in_normal("triangular", bell, triangle),
            "in.toml:1:43: traction.normal: neither stiffness nor peak_opening is given (the curve is elastic up to its peak); add "
            "stiffness = ...\n");
  EXPECT_EQ(
      in_normal("triangular", triangle + ", peak_opening = 1e-5", triangle),
      "in.toml:1:78: traction.normal.stiffness: \"peak_opening\" and \"stiffness\" are both given (they contradict each other); remove "
      "one of them\n");
  EXPECT_EQ(
      in_normal("triangular", "strength = 5e6, toughness = 250, peak_opening = \"1 mm\"", triangle),
      "in.toml:1:43: traction.normal: the opening at the peak is not below the final opening (0.001 m and 0.0001 m); correct strength, "
      "toughness, openings or stiffness\n");
  EXPECT_EQ(in_normal("trilinear", triangle + ", knee_stress = 9e6, knee_opening = 1.5e-5",
                      triangle + ", knee_stress = 2e6, knee_opening = 2e-5"),
            "in.toml:1:95: traction.normal.knee_stress: the knee is not below the elastic line (6e+11 Pa/m from the origin, and "
            "5e+11 Pa/m to the peak); reduce knee_stress or increase knee_opening\n");
  // The toughness goes into the second piece; what is left for the first is negative.
  EXPECT_EQ(in_normal("trilinear", "final_opening = 1e-4, toughness = 50, peak_opening = 1e-5, knee_stress = 2e6, knee_opening = 3e-5",
                      triangle + ", knee_stress = 2e6, knee_opening = 3e-5"),
            "in.toml:1:66: traction.normal.toughness: the toughness leaves no strength (the strength would be -2.66667e+06 Pa); make it "
            "tougher, or final_opening smaller\n");
  const std::string table = "openings = [1e-5, 1e-4], stresses = [5e6, 0]";
  EXPECT_EQ(in_normal("user_curve", table, table), "no error\n");
  EXPECT_EQ(
      in_normal("user_curve", "openings = [0.1, 0.1, 0.2], stresses = [1, 2, 0]", table),
      "in.toml:1:62: traction.normal.openings[1]: the openings do not rise (0.1 m after 0.1 m); sort the table\n"
      "in.toml:1:88: traction.normal.stresses[1]: the stress rises after the peak (2 Pa after 1 Pa); let the table begin at the largest "
      "stress\n");
  EXPECT_EQ(in_normal("user_curve", "openings = [0.1, 0.2], stresses = [1, 1, 0]", table),
            "in.toml:1:68: traction.normal.stresses: 3 stresses for 2 openings (each point of the table has both); add or remove some\n");
  EXPECT_NE(errors("{ law = \"cubik\" }").find("in.toml:1:20: traction.law: unknown traction law \"cubik\""), std::string::npos);
}

}  // namespace
}  // namespace crampon::test
