/// What every traction law must do, for every law that is registered: a new one is tested without a list (traction_law_examples()).

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "crampon/input/reference.hpp"
#include "crampon/input/schema.hpp"
#include "unit/traction_law_checks.hpp"

namespace crampon::test {
namespace {

struct Member {
  std::string name;
  TractionLawSpec law;
};
void PrintTo(const Member& m, std::ostream* out) { *out << m.name; }

/// Examples of one law are numbered.
std::vector<Member> members() {
  std::vector<Member> all;
  for (const TractionLawSpec& law : traction_law_examples()) {
    int number = 1;
    for (const Member& m : all) number += m.law->name() == law->name();
    all.push_back({law->name() + "_" + std::to_string(number), law});
  }
  return all;
}

class EveryTractionLaw : public testing::TestWithParam<Member> {
 protected:
  const TractionLaw& law = *GetParam().law;
};
INSTANTIATE_TEST_SUITE_P(Laws, EveryTractionLaw, testing::ValuesIn(members()), [](const auto& of) { return of.param.name; });

TEST_P(EveryTractionLaw, StartsWhole) { check_starts_whole(law); }
TEST_P(EveryTractionLaw, Resists) { check_resists(law); }
TEST_P(EveryTractionLaw, AccountsForTheWorkDoneOnIt) { check_accounts_for_work(law); }
TEST_P(EveryTractionLaw, TakesItsToughness) { check_toughness(law); }

TEST_P(EveryTractionLaw, StandsInTheSchemaAndOnTheReferencePage) {
  const Alternative* of = traction_laws().find(law.name());
  ASSERT_NE(of, nullptr);
  const std::string schema = json_schema(), page = reference_page();
  EXPECT_NE(schema.find("\"" + law.name() + "\""), std::string::npos);
  EXPECT_NE(page.find("### " + law.name() + "\n\n" + of->record->help()), std::string::npos);
  for (const Entry& entry : of->record->entries()) {
    EXPECT_NE(schema.find("\"" + entry.key + "\""), std::string::npos) << entry.key;
    EXPECT_NE(page.find("| `" + entry.key + "` |"), std::string::npos) << entry.key;
  }
}

TEST(TractionFamily, EveryLawHasAnExample) {
  std::set<std::string> with_example, listed;
  for (const TractionLawSpec& law : traction_law_examples()) with_example.insert(law->name());
  for (const Alternative& of : traction_laws().alternatives()) listed.insert(of.name());
  EXPECT_EQ(with_example, listed);
}

TEST(TractionFamily, WithoutALawFacesAreFree) {
  EXPECT_EQ(TractionLawSpec()->name(), "none");
  EXPECT_FALSE(TractionLawSpec()->acts());
  for (const TractionLawSpec& law : traction_law_examples()) EXPECT_EQ(law->acts(), law->name() != "none") << law->name();
}

}  // namespace
}  // namespace crampon::test
