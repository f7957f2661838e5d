/// What every contact law must do, for every law that is registered: a new one is tested without a list (contact_law_examples()).

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "crampon/contact/strictest.hpp"
#include "crampon/input/read_problem.hpp"
#include "crampon/input/reference.hpp"
#include "crampon/input/resolved.hpp"
#include "crampon/input/schema.hpp"
#include "unit/contact_law_checks.hpp"

namespace crampon::test {
namespace {

struct Member {
  std::string name;
  ContactLawSpec law;
};
void PrintTo(const Member& m, std::ostream* out) { *out << m.name; }

/// Examples of one law are numbered.
std::vector<Member> members() {
  std::vector<Member> all;
  for (const ContactLawSpec& law : contact_law_examples()) {
    int number = 1;
    for (const Member& m : all) number += m.law->name() == law->name();
    all.push_back({law->name() + "_" + std::to_string(number), law});
  }
  return all;
}

class EveryContactLaw : public testing::TestWithParam<Member> {
 protected:
  const ContactLawSpec& law = GetParam().law;
};
INSTANTIATE_TEST_SUITE_P(Laws, EveryContactLaw, testing::ValuesIn(members()), [](const auto& of) { return of.param.name; });

TEST_P(EveryContactLaw, ResistsSlipAndNeverTurnsIt) { check_limit_resists(*law); }
TEST_P(EveryContactLaw, ReadsOnlyWhatItAsksFor) { check_reads_what_it_asks_for(*law); }
TEST_P(EveryContactLaw, AsksForNothingInVain) { check_asks_for_nothing_in_vain(*law); }
TEST_P(EveryContactLaw, LimitsAStress) { check_limit_is_a_stress(*law); }
TEST_P(EveryContactLaw, HoldsWhatItHoldsUnderLess) { check_adhesion(*law); }
TEST_P(EveryContactLaw, RemembersWhatItSays) { check_memory_grows(*law); }
TEST_P(EveryContactLaw, IsTheSameFromBothSidesAndInEveryFrame) {
  check_symmetries<2>(*law);
  check_symmetries<3>(*law);
}
TEST_P(EveryContactLaw, PressesRubsAndGainsNothing) {
  check_impulses<2>(*law);
  check_impulses<3>(*law);
}
TEST_P(EveryContactLaw, MovesAsOneWhereItJoins) {
  check_joined<2>(*law);
  check_joined<3>(*law);
}

const char* const two_blocks = R"(
analysis = "plane_strain"
[grid]
origin = [0, 0]
size = [0.1, 0.1]
cell = 0.01
[time]
steps = 1
[[material]]
name = "m"
law = "neo_hookean"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "low"
material = "m"
shape = { kind = "rectangle", low = [0.02, 0.02], high = [0.08, 0.05] }
[[body]]
name = "high"
material = "m"
shape = { kind = "rectangle", low = [0.02, 0.05], high = [0.08, 0.08] }
)";

/// What is read is what was written, key by key, and what the program writes of it reads back as the same.
TEST_P(EveryContactLaw, IsReadAsItIsWritten) {
  const Alternative* of = contact_laws().holding(&law);
  ASSERT_NE(of, nullptr);
  EXPECT_EQ(of->name(), law->name());
  std::string table = "{ law = \"" + law->name() + "\"";
  for (const Entry& entry : of->record->entries()) {
    const std::string value = toml_text(entry.get(of->view(&law)));
    if (!value.empty()) table += ", " + entry.key + " = " + value;
  }
  const Problem read =
      read_problem_text(std::string(two_blocks) + "[contact]\nfields = \"bodies\"\ndefault = " + table + " }\n", "test.toml");
  const ContactLawSpec& back = read.contact.between_fields;
  ASSERT_EQ(contact_laws().holding(&back), of);
  for (const Entry& entry : of->record->entries())
    EXPECT_EQ(toml_text(entry.get(of->view(&back))), toml_text(entry.get(of->view(&law)))) << entry.key;
  const std::string resolved = write_resolved(read);
  EXPECT_EQ(write_resolved(read_problem_text(resolved, "resolved.toml")), resolved);
}

TEST_P(EveryContactLaw, StandsInTheSchemaAndOnTheReferencePage) {
  const Alternative& of = *contact_laws().holding(&law);
  const std::string schema = json_schema(), page = reference_page();
  EXPECT_NE(schema.find("\"" + law->name() + "\""), std::string::npos);
  EXPECT_NE(page.find("### " + law->name() + "\n\n" + of.record->help()), std::string::npos);
  for (const Entry& entry : of.record->entries()) {
    EXPECT_NE(schema.find("\"" + entry.key + "\""), std::string::npos) << entry.key;
    EXPECT_NE(page.find("| `" + entry.key + "` |"), std::string::npos) << entry.key;
  }
}

TEST(ContactFamily, EveryLawHasAnExample) {
  std::set<std::string> with_example, listed;
  for (const ContactLawSpec& law : contact_law_examples()) with_example.insert(law->name());
  for (const Alternative& of : contact_laws().alternatives()) listed.insert(of.name());
  EXPECT_EQ(with_example, listed);
}

/// Of any two laws one rules, whichever is named first; one that ignores gives way to all, and one that joins to none.
TEST(ContactFamily, StrictnessIsAnOrder) {
  const std::vector<ContactLawSpec> laws = contact_law_examples();
  for (const ContactLawSpec& a : laws) {
    for (const ContactLawSpec& b : laws) {
      SCOPED_TRACE(a->name() + " and " + b->name());
      const ContactLaw& rules = strictest(*a, *b);
      EXPECT_TRUE(&rules == &*a || &rules == &*b);
      EXPECT_EQ(rules.strictness(), strictest(*b, *a).strictness());
      if (a->ignores()) {
        EXPECT_EQ(rules.strictness(), b->strictness());
      }
      if (a->bonds()) {
        EXPECT_EQ(rules.strictness(), a->strictness());
      }
      for (const ContactLawSpec& c : laws)
        EXPECT_EQ(strictest(strictest(*a, *b), *c).strictness(), strictest(*a, strictest(*b, *c)).strictness());
    }
  }
}

TEST(ContactFamily, WithoutALawFacesAreFrictionless) { EXPECT_EQ(ContactLawSpec()->name(), "frictionless"); }

}  // namespace
}  // namespace crampon::test
