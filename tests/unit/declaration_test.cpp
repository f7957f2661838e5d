#include "crampon/core/declaration.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/core/closest_name.hpp"
#include "crampon/core/units.hpp"
#include "crampon/input/problem.hpp"

namespace crampon {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

enum class Colour { red, green };
struct Part : Located {
  double size = 3;
};
struct Sample : Located {
  double length = 2;
  std::optional<double> limit;
  std::int64_t count = 4;
  int small = 5;
  bool on = true;
  Colour colour = Colour::green;
  std::vector<Part> parts;
  std::optional<Part> extra;
  ContactLawSpec law;
};

const Declaration<Part>& part_declaration() {
  static const auto d = Declaration<Part>("part", "A part.").quantity("size", &Part::size, "m", Bounds::positive(), "how big");
  return d;
}
Declaration<Sample> sample_declaration() {
  return Declaration<Sample>("sample", "A sample.")
      .quantity("length", &Sample::length, "m", Bounds::positive(), "how long", Presence::required)
      .quantity("limit", &Sample::limit, "m", Bounds::any(), "how long at most")
      .integer("count", &Sample::count, Bounds::any(), "how many")
      .integer("small", &Sample::small, Bounds::any(), "how few")
      .flag("on", &Sample::on, "whether")
      .choice("colour", &Sample::colour, {{"red", Colour::red}, {"green", Colour::green}}, "which")
      .records("part", &Sample::parts, part_declaration, "parts")
      .record("extra", &Sample::extra, part_declaration, "one more")
      .one_of("contact", &Sample::law, contact_laws, "law");
}

TEST(Bounds, EndsBelongWhereTheyAreClosed) {
  EXPECT_TRUE(Bounds::positive().contains(1e-300));
  EXPECT_FALSE(Bounds::positive().contains(0));
  EXPECT_TRUE(Bounds::non_negative().contains(0));
  EXPECT_FALSE(Bounds::non_negative().contains(-1e-300));
  EXPECT_TRUE(Bounds::between(1, 2).contains(1) && Bounds::between(1, 2).contains(2));
  EXPECT_FALSE(Bounds::inside(1, 2).contains(1) || Bounds::inside(1, 2).contains(2));
  EXPECT_TRUE(Bounds::from_below(1, 2).contains(1) && !Bounds::from_below(1, 2).contains(2));
  EXPECT_TRUE(!Bounds::from_above(1, 2).contains(1) && Bounds::from_above(1, 2).contains(2));
  EXPECT_FALSE(Bounds::any().contains(infinity));
  EXPECT_FALSE(Bounds::any().contains(std::nan("")));
  EXPECT_TRUE(Bounds::any_or_infinite().contains(-infinity));
  EXPECT_FALSE(Bounds::any_or_infinite().contains(std::nan("")));
  EXPECT_EQ(Bounds::any().text(), "");
  EXPECT_EQ(Bounds::from_below(0, 0.5).text(), ">= 0 and < 0.5");
  EXPECT_EQ(Bounds::below(3).text(), "< 3");
  EXPECT_EQ(Length::exactly(2).text(), "2");
  EXPECT_EQ(Length::between(1, 3).text(), "1 to 3");
  EXPECT_EQ(Length::at_least(2).text(), "at least 2");
}

TEST(Declaration, EntriesReadAndWriteTheirMembers) {
  const auto d = sample_declaration();
  Sample s;
  d.find("length")->set(&s, 7.);
  EXPECT_EQ(s.length, 7);
  EXPECT_EQ(std::get<double>(d.find("length")->get(&s)), 7);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(d.find("limit")->get(&s)));
  d.find("limit")->set(&s, 1.);
  EXPECT_EQ(s.limit, 1.);
  d.find("small")->set(&s, std::int64_t{-3});
  EXPECT_EQ(s.small, -3);
  EXPECT_FALSE(d.find("small")->bounds.contains(3e9));
  d.find("colour")->set(&s, std::string("red"));
  EXPECT_EQ(s.colour, Colour::red);
  EXPECT_EQ(std::get<std::string>(d.find("colour")->get(&s)), "red");
  EXPECT_EQ(d.find("nothing"), nullptr);
}

TEST(Declaration, DefaultsAreThoseOfTheStruct) {
  const auto d = sample_declaration();
  const auto object = d.create();
  EXPECT_EQ(std::get<std::int64_t>(d.find("count")->get(object.get())), 4);
  EXPECT_EQ(std::get<std::string>(d.find("colour")->get(object.get())), "green");
  EXPECT_EQ(d.find("contact")->family().holding(d.find("contact")->parts(object.get())[0])->name(), "frictionless");
}

TEST(Declaration, SubRecordsAreMadeInPlace) {
  const auto d = sample_declaration();
  Sample s;
  EXPECT_TRUE(d.find("extra")->parts(&s).empty());
  part_declaration().find("size")->set(d.find("extra")->emplace(&s), 8.);
  EXPECT_EQ(s.extra->size, 8);
  d.find("part")->emplace(&s);
  part_declaration().find("size")->set(d.find("part")->emplace(&s), 9.);
  ASSERT_EQ(s.parts.size(), 2u);
  EXPECT_EQ(s.parts[1].size, 9);
  EXPECT_EQ(d.located(&s), static_cast<Located*>(&s));
}

TEST(Declaration, ChecksPointAtKeys) {
  const auto d = sample_declaration().check([](const Sample& s, Diagnostics& diagnostics) {
    if (s.count > 3) diagnostics.add("count", "too many", "three is a crowd", "take fewer");
  });
  Diagnostics diagnostics;
  Located here;
  here.location = {"in.toml", 3, 1, "sample"};
  here.keys["count"] = {"in.toml", 5, 1, "sample.count"};
  diagnostics.enter(here);
  d.check(d.create().get(), diagnostics);
  ASSERT_EQ(diagnostics.list().size(), 1u);
  EXPECT_EQ(diagnostics.list()[0].text(), "in.toml:5:1: sample.count: too many (three is a crowd); take fewer");
  EXPECT_THROW(diagnostics.throw_if_any(), InputError);
}

TEST(Declaration, TwiceTheSameKeyOrAlternativeIsRefused) {
  EXPECT_THROW(sample_declaration().flag("on", &Sample::on, "again"), std::logic_error);
  Family<ContactLawSpec> family("law", "law", "Laws.");
  family.add(CoulombContact::declaration());
  EXPECT_THROW(family.add(CoulombContact::declaration()), std::logic_error);
}

TEST(Family, BuildsWhatItsAlternativesDeclare) {
  const Alternative* coulomb = contact_laws().find("coulomb");
  ASSERT_NE(coulomb, nullptr);
  const auto object = coulomb->record->create();
  coulomb->record->find("friction")->set(object.get(), 0.25);
  const auto law = std::any_cast<ContactLawSpec>(coulomb->build(object.get()));
  EXPECT_EQ(law.as<CoulombContact>()->friction, 0.25);
  EXPECT_EQ(contact_laws().holding(&law), coulomb);
}

TEST(ClosestName, FindsTypingErrorsOnly) {
  const std::vector<std::string> keys = {"origin", "size", "cell", "particles_per_cell"};
  EXPECT_EQ(closest_name("cel", keys), "cell");
  EXPECT_EQ(closest_name("Cell", keys), "cell");
  EXPECT_EQ(closest_name("orgiin", keys), "origin");
  EXPECT_EQ(closest_name("particle_per_cells", keys), "particles_per_cell");
  EXPECT_EQ(closest_name("banana", keys), std::nullopt);
  EXPECT_EQ(closest_name("", keys), std::nullopt);
  EXPECT_EQ(closest_name(std::string(100000, 'x'), keys), std::nullopt);
  EXPECT_EQ(suggest_from("siez", keys), "did you mean \"size\"?");
  EXPECT_EQ(suggest_from("banana", {"a", "b"}), "choose from: a, b");
}

// Walks every record that an input can contain.
class Walker {
 public:
  void walk(const Record& record) {
    if (!seen_.insert(&record).second) return;
    const auto defaults = record.create();
    for (const Entry& entry : record.entries()) {
      SCOPED_TRACE(record.name() + "." + entry.key);
      EXPECT_FALSE(entry.help.empty());
      check_entry(record, entry, defaults.get());
      if (entry.record) walk(entry.record());
      if (!entry.family) continue;
      for (const Alternative& alternative : entry.family().alternatives()) {
        walk(*alternative.record);
        if (entry.kind != Entry::Kind::inline_one_of) continue;
        for (const Entry& inner : alternative.record->entries()) EXPECT_EQ(record.find(inner.key), nullptr) << inner.key;
      }
    }
  }
  std::size_t count() const { return seen_.size(); }

 private:
  std::set<const Record*> seen_;

  static void check_entry(const Record& record, const Entry& entry, const void* defaults) {
    for (const std::string& other : entry.excludes) EXPECT_NE(record.find(other), nullptr) << other;
    if (!entry.unit.empty() && entry.unit != "any") {
      EXPECT_NO_THROW(unit_factor(entry.unit, entry.unit)) << entry.unit;
    }
    for (const auto& [word, unit] : entry.units) EXPECT_NO_THROW(unit_factor(unit, unit)) << unit;
    if (!entry.plain() || entry.presence == Presence::required) return;
    const EntryValue value = entry.get(defaults);
    if (const auto* x = std::get_if<double>(&value)) {
      EXPECT_TRUE(entry.bounds.contains(*x)) << *x;
    }
    if (const auto* i = std::get_if<std::int64_t>(&value)) {
      EXPECT_TRUE(entry.bounds.contains(double(*i))) << *i;
    }
    if (entry.kind == Entry::Kind::choice && !std::holds_alternative<std::monostate>(value)) {
      EXPECT_NE(std::get<std::string>(value), "");
    }
  }
};

TEST(ProblemDeclaration, EveryKeyIsExplainedAndEveryDefaultAllowed) {
  Walker walker;
  walker.walk(problem_declaration());
  // The tables of an input, three materials, five contact laws and the shapes.
  EXPECT_GT(walker.count(), 30u);
}

}  // namespace
}  // namespace crampon
