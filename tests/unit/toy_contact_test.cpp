/// A further contact law is one struct and one line: a toy, added here, is known to the parser, the schema, the reference page, the tests of the family
/// (contact_family_test.cpp is part of this program) and the engine. Laws that break a rule show that the tests of the family find it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "unit/contact_law_checks.hpp"
#include "unit/failure_of_check.hpp"
#include "verification/on_floor.hpp"

namespace crampon::test {
namespace {

/// Putty between two faces: it bears a shear stress whatever the pressure, less of it the further the faces have slipped.
struct Putty {
  double stress = 0;    ///< Pa, before slip
  double distance = 0;  ///< m

  static constexpr const char* name = "toy_putty";
  static constexpr Meeting meeting = Meeting::pressing;
  static constexpr bool adheres = false;
  static std::vector<Putty> examples() { return {{1e5, 0.01}}; }
  bool needs_area() const { return true; }
  Remembered remembers() const { return Remembered::slip; }
  Strictness strictness() const { return {Strictness::Holds::friction, 0, stress}; }
  SlidingLimit limit(const Sliding& s) const { return SlidingLimit::up_to(s, 0, stress * std::exp(-s.slip / distance) * s.area * s.dt); }
  static const Declaration<Putty>& declaration() {
    static const auto d =
        Declaration<Putty>(name, "Putty that exists in a test.")
            .quantity("stress", &Putty::stress, "Pa", Bounds::positive(), "shear stress of putty at rest", Presence::required)
            .quantity("distance", &Putty::distance, "m", Bounds::positive(), "slip that leaves 1/e of the putty's stress",
                      Presence::required);
    return d;
  }
};

/// The one line; before main(), so that the tests of the family find it.
const bool joined = (add_contact_law<Putty>(contact_laws()), true);

TEST(ToyContact, IsTestedAsAnyOther) {
  ASSERT_TRUE(joined);
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::set<std::string> of_putty, of_coulomb;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const std::string test = suite.GetTestInfo(t)->name();
      if (const std::size_t at = test.find("/toy_putty_1"); at != std::string::npos) of_putty.insert(test.substr(0, at));
      if (const std::size_t at = test.find("/coulomb_1"); at != std::string::npos) of_coulomb.insert(test.substr(0, at));
    }
  }
  EXPECT_GT(of_putty.size(), 10u);
  EXPECT_EQ(of_putty, of_coulomb);
}

const std::string putty_floor = "{ law = \"toy_putty\", stress = \"40 Pa\", distance = \"5 mm\" }";

TEST(ToyContact, IsCheckedAsAnyOther) {
  OnFloor setup;
  setup.law = putty_floor;
  const auto error = [&](const std::string& from, const std::string& to) {
    std::string text = input(setup);
    text.replace(text.find(from), from.size(), to);
    try {
      read_problem_text(text, "test.toml");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(error("40 Pa", "50 Pa"), "no error");
  EXPECT_NE(error("\"toy_putty\"", "\"toy_puty\"").find("did you mean \"toy_putty\"?"), std::string::npos);
  EXPECT_NE(error("stress = \"40", "stres = \"40").find("did you mean \"stress\"?"), std::string::npos);
  EXPECT_NE(error("5 mm", "5 s").find("dimension"), std::string::npos);
  EXPECT_NE(error("5 mm", "-5 mm").find("out of bounds"), std::string::npos);
}

/// A block of height h and density rho that slides on putty: v^2 = v_0^2 - 2 tau L/(rho h) (1 - e^(-s/L)). What is seen beside it are the waves in the
/// block, as in friction_test: 1 % of the speed at the start.
TEST(ToyContact, SlowsABlockInTheEngine) {
  constexpr double v_0 = 0.3, stress = 40, distance = 0.005;
  OnFloor setup;
  setup.law = putty_floor;
  setup.velocity = v_0;
  setup.end = 0.04;
  const Motion m = follow(setup, Places::yes);
  double worst = 0, v = v_0;
  for (std::size_t i = 0; i < m.t.size(); ++i) {
    v = std::sqrt(v_0 * v_0 - 2 * stress * distance / (1000 * setup.height) * (1 - std::exp(-m.x[i] / distance)));
    worst = std::fmax(worst, std::fabs(m.v[i] - v));
  }
  RecordProperty("worst_percent", fmt::format("{:.4f}", 100 * worst / v_0));
  EXPECT_LT(v, 0.8 * v_0) << "the putty has hardly acted";
  EXPECT_LT(worst, 0.01 * v_0);
  const double lost = 0.5 * m.mass * (v_0 * v_0 - m.v.back() * m.v.back());
  EXPECT_NEAR(m.at_end("friction_loss"), lost, 0.01 * lost);
}

/// Putty with some answers changed.
class Altered : public ContactLaw {
 public:
  std::function<SlidingLimit(const Sliding&)> limits = [](const Sliding& s) { return Putty{1e5, 0.01}.limit(s); };
  std::function<bool(const Pull&)> bears_pull = [](const Pull&) { return false; };

  struct Answers {
    bool adheres = false, needs_area = true;
    Remembered remembers = Remembered::slip;
  };
  explicit Altered(const Answers& a) : ContactLaw({Meeting::pressing, a.adheres, a.needs_area, a.remembers, {}, {}}) {}
  std::string name() const override { return "altered"; }
  SlidingLimit limit(const Sliding& s) const override { return limits(s); }

 private:
  bool bears(const Pull& pull) const override { return bears_pull(pull); }
};

TEST(BrokenContact, IsFound) {
  Altered sound({});
  EXPECT_FALSE(finds("", [&] {
    check_limit_resists(sound), check_reads_what_it_asks_for(sound), check_asks_for_nothing_in_vain(sound), check_limit_is_a_stress(sound);
    check_adhesion(sound), check_memory_grows(sound), check_symmetries<2>(sound), check_impulses<3>(sound);
  }));

  Altered drives({});
  drives.limits = [](const Sliding&) { return SlidingLimit{false, -0.3, 0}; };
  EXPECT_TRUE(finds("limit.per_normal", [&] { check_limit_resists(drives); }));

  Altered turns({});
  turns.limits = [](const Sliding& s) { return SlidingLimit{false, 0, 1.5 * s.full}; };
  EXPECT_TRUE(finds("s.full", [&] { check_limit_resists(turns); }));
  EXPECT_TRUE(finds("turns slip round", [&] { check_impulses<2>(turns); }));

  Altered no_area({.needs_area = false});
  EXPECT_TRUE(finds("without asking", [&] { check_reads_what_it_asks_for(no_area); }));

  Altered no_memory({.remembers = Remembered::nothing});
  EXPECT_TRUE(finds("without asking", [&] { check_reads_what_it_asks_for(no_memory); }));

  Altered in_vain({});
  in_vain.limits = [](const Sliding& s) { return SlidingLimit::up_to(s, 0.3); };
  EXPECT_TRUE(finds("law.needs_area()", [&] { check_asks_for_nothing_in_vain(in_vain); }));
  EXPECT_TRUE(finds("law.remembers()", [&] { check_asks_for_nothing_in_vain(in_vain); }));

  Altered no_time({});
  no_time.limits = [](const Sliding& s) { return SlidingLimit::up_to(s, 0, 1e-3 * s.area * std::exp(-s.slip)); };
  EXPECT_TRUE(finds("fall with the time", [&] { check_limit_is_a_stress(no_time); }));

  Altered a_force({});
  a_force.limits = [](const Sliding& s) { return SlidingLimit::up_to(s, 0, 10 * s.dt * std::exp(-s.slip)); };
  EXPECT_TRUE(finds("grow with the area", [&] { check_limit_is_a_stress(a_force); }));

  Altered snaps({.adheres = true});
  snaps.bears_pull = [](const Pull& pull) { return pull.normal > 1e5 * pull.area * pull.dt; };
  EXPECT_TRUE(finds("holds more than it holds", [&] { check_adhesion(snaps); }));
}

}  // namespace
}  // namespace crampon::test
