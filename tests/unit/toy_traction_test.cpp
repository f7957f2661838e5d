/// A further traction law is one struct and one line: a toy, added here, is known to the parser, the schema, the reference page, the tests of the family
/// (traction_family_test.cpp is part of this program) and the engine. Laws that break a rule show that the tests of the family find it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "run_case.hpp"
#include "unit/failure_of_check.hpp"
#include "unit/traction_law_checks.hpp"

namespace crampon::test {
namespace {

/// Strings across the crack: they resist opening alone, as springs, and all break at once.
struct Strings {
  double stiffness = 0;     ///< Pa/m
  double last_opening = 0;  ///< m, at which they break

  using Input = Strings;
  static constexpr const char* name = "toy_strings";
  static constexpr bool acts = true;
  static constexpr bool acts_closed = false;
  static constexpr bool from_outside = false;
  static Strings make(const Input& input) { return input; }
  static std::vector<Strings> examples() { return {{1e11, 2e-5}}; }
  Traction respond(const PerMode& u, double, const Vec<3>&, TractionHistory& history) const {
    history.largest_normal_opening = std::max(history.largest_normal_opening, u.normal);
    if (u.normal >= last_opening) {
      history.failed = history.damage = 1;
      history.dissipated_normal = toughness().normal;
      return {};
    }
    return {stiffness * u.normal, 0, 0.5 * stiffness * u.normal * u.normal};
  }
  double largest_stiffness() const { return stiffness; }
  PerMode toughness() const { return {0.5 * stiffness * last_opening * last_opening, 0}; }
  static const Declaration<Strings>& declaration() {
    static const auto d =
        Declaration<Strings>(name, "Strings that exist in a test.")
            .quantity("stiffness", &Strings::stiffness, "Pa/m", Bounds::positive(), "traction of strings per opening", Presence::required)
            .quantity("last_opening", &Strings::last_opening, "m", Bounds::positive(), "opening at which strings break",
                      Presence::required);
    return d;
  }
};

/// The one line; before main(), so that the tests of the family find it.
const bool joined = (add_traction_law<Strings>(traction_laws()), true);

TEST(ToyTraction, IsTestedAsAnyOther) {
  ASSERT_TRUE(joined);
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::set<std::string> of_strings, of_cubic;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const std::string test = suite.GetTestInfo(t)->name();
      if (const std::size_t at = test.find("/toy_strings_1"); at != std::string::npos) of_strings.insert(test.substr(0, at));
      if (const std::size_t at = test.find("/cubic_1"); at != std::string::npos) of_cubic.insert(test.substr(0, at));
    }
  }
  EXPECT_GE(of_strings.size(), 5u);
  EXPECT_EQ(of_strings, of_cubic);
}

/// Two halves of a stiff strip, 20 mm wide and 10 mm thick, held together by strings and moved apart.
const std::string strip = R"in(
analysis = "plane_strain"
[grid]
origin = ["-4 mm", "-16 mm"]
size = ["28 mm", "32 mm"]
cell = "2 mm"
[time]
end = "0.6 ms"
courant = 0.4
[method]
damping = 20000
[[material]]
name = "stiff"
law = "elastic_small_strain"
E = "10 GPa"
nu = 0
density = "1000 kg/m3"
[[body]]
name = "strip"
material = "stiff"
shape = { kind = "rectangle", low = ["0 mm", "-8 mm"], high = ["20 mm", "8 mm"] }
thickness = "10 mm"
[[crack]]
name = "tied"
points = [["-2 mm", "0 mm"], ["22 mm", "0 mm"]]
contact = { law = "frictionless" }
traction = { law = "toy_strings", stiffness = "100 GPa/m", last_opening = "20 um" }
traction_region = { kind = "rectangle", low = ["0 mm", "-1 mm"], high = ["20 mm", "1 mm"] }
[[boundary]]
name = "top"
region = { kind = "rectangle", low = ["-10 mm", "4 mm"], high = ["30 mm", "16 mm"] }
vy = 0.03
[[boundary]]
name = "bottom"
region = { kind = "rectangle", low = ["-10 mm", "-16 mm"], high = ["30 mm", "-4 mm"] }
vy = -0.03
)in";

TEST(ToyTraction, IsCheckedAsAnyOther) {
  const auto error = [](const std::string& from, const std::string& to) {
    std::string text = strip;
    text.replace(text.find(from), from.size(), to);
    try {
      read_problem_text(text, "test.toml");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(error("20 um", "30 um"), "no error");
  EXPECT_NE(error("\"toy_strings\"", "\"toy_string\"").find("did you mean \"toy_strings\"?"), std::string::npos);
  EXPECT_NE(error("last_opening", "last_openin").find("did you mean \"last_opening\"?"), std::string::npos);
  EXPECT_NE(error("20 um", "20 us").find("dimension"), std::string::npos);
  EXPECT_NE(error("20 um", "-20 um").find("out of bounds"), std::string::npos);
}

/// The strings break at 2 MPa, everywhere at once, and take 20 J/m2. 3 % of the force for inertia, as in crack_traction_test.
TEST(ToyTraction, HoldsACrackTogetherInTheEngine) {
  constexpr double area = 0.02 * 0.01, strength = 2e6, toughness = 20;
  const auto simulation = make(strip);
  double largest_force = 0;  // before strings break: then the halves snap back
  run(*simulation, [&](Simulation& s) {
    if (s.event_count() == 0) largest_force = std::fmax(largest_force, value(s, "reaction_y.top"));
  });
  RecordProperty("force", fmt::format("{:.4f}", largest_force / (strength * area)));
  RecordProperty("energy", fmt::format("{:.5f}", value(*simulation, "cohesive_loss_I") / (toughness * area)));
  EXPECT_NEAR(largest_force, strength * area, 0.03 * strength * area);
  EXPECT_NEAR(value(*simulation, "cohesive_loss_I"), toughness * area, 1e-9 * toughness * area);
  EXPECT_EQ(value(*simulation, "cohesive_loss_II"), 0);
  EXPECT_EQ(simulation->event_count(), 21u);  // every vertex
}

/// Strings with some answers changed.
class Altered : public TractionLaw {
 public:
  std::function<Traction(const PerMode&, TractionHistory&)> answer = [](const PerMode& u, TractionHistory& history) {
    return Strings{1e11, 2e-5}.respond(u, 0, {}, history);
  };
  double stiffness = 1e11;
  PerMode energy{20, 0};

  std::string name() const override { return "altered"; }
  bool acts() const override { return true; }
  bool acts_closed() const override { return false; }
  bool from_outside() const override { return false; }
  Traction respond(const PerMode& u, double, const Vec<3>&, TractionHistory& history) const override { return answer(u, history); }
  double largest_stiffness() const override { return stiffness; }
  PerMode toughness() const override { return energy; }
};

TEST(BrokenTraction, IsFound) {
  const Altered sound;
  EXPECT_FALSE(finds("", [&] { check_starts_whole(sound), check_resists(sound), check_accounts_for_work(sound), check_toughness(sound); }));

  Altered soft;
  soft.stiffness = 0.9e11;
  EXPECT_TRUE(finds("stiffer than it says", [&] { check_resists(soft); }));

  Altered tougher;
  tougher.energy = {21, 0};
  EXPECT_TRUE(finds("another energy", [&] { check_toughness(tougher); }));

  Altered early;  // strings that do not break, since the path presses faces only later
  early.answer = [&](const PerMode& u, TractionHistory& history) {
    Traction T = Strings{1e11, 1}.respond(u, 0, {}, history);
    T.normal += 1;
    return T;
  };
  EXPECT_TRUE(finds("have not moved", [&] { check_starts_whole(early); }));
  EXPECT_TRUE(finds("faces that press", [&] { check_resists(early); }));

  Altered drives;
  drives.answer = [&](const PerMode& u, TractionHistory& history) {
    Traction T = sound.answer(u, history);
    T.shear = -1e3 * u.shear;
    return T;
  };
  EXPECT_TRUE(finds("drives sliding", [&] { check_resists(drives); }));

  Altered repels;
  repels.answer = [](const PerMode& u, TractionHistory&) { return Traction{-1e3 * u.normal, 0, 0}; };
  EXPECT_TRUE(finds("pushes faces apart", [&] { check_resists(repels); }));

  Altered heals;
  heals.answer = [](const PerMode& u, TractionHistory& history) {
    history.damage = u.normal * 1e3;
    return Traction{};
  };
  EXPECT_TRUE(finds("heals", [&] { check_resists(heals); }));

  Altered forgets;
  forgets.answer = [&](const PerMode& u, TractionHistory& history) {
    Traction T = sound.answer(u, history);
    T.stored = 0;
    return T;
  };
  EXPECT_TRUE(finds("lost or made", [&] { check_accounts_for_work(forgets); }));
}

}  // namespace
}  // namespace crampon::test
