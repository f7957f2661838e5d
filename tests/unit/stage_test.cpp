/// The executor of a step on lines that write down that they ran, and what the lines of the real step say of themselves.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "crampon/shape/bspline.hpp"
#include "crampon/shape/linear.hpp"
#include "crampon/step/advance.hpp"
#include "crampon/step/stage.hpp"

namespace crampon {
namespace {

using S = State<2>;
using W = StepWork<2>;
using M = Model<2>;

std::vector<std::string> log_of_run;  // NOLINT: verbs are plain functions
void one(S&, W&, const M&, std::size_t b) { log_of_run.push_back("one " + std::to_string(b)); }
void two(W&, const M&, std::size_t b) { log_of_run.push_back("two " + std::to_string(b)); }
void three(W&, std::size_t b) { log_of_run.push_back("three " + std::to_string(b)); }
void all(S&, W&, const M&) { log_of_run.emplace_back("all"); }
void state_alone(S&) { log_of_run.emplace_back("state"); }
void count_term(W& work, std::size_t b) { log_of_run.push_back("term " + std::to_string(work.now.term) + " " + std::to_string(b)); }
bool never(const S&, const W&, const M&) { return false; }
bool holds(const M&) { return true; }
bool fails(const M&) { return false; }

std::vector<std::string> ran(const std::vector<Stage<2>>& stages, int terms = 0) {
  log_of_run.clear();
  S state;
  W work;
  M model;
  model.threads = 1;
  work.blocks.list.resize(2);
  work.now.transfer.terms = terms;
  run_stages(stages, state, work, model);
  return log_of_run;
}
Stage<2> on_blocks(const char* name, Stage<2>::OnBlock f, Reach reach = {}, Stage<2>::When when = nullptr) {
  return {name, reach, when, nullptr, f, {}};
}
using Log = std::vector<std::string>;

TEST(Stages, VerbsOfALineRunOneAfterAnotherOnEachBlock) {
  EXPECT_EQ(ran({on_blocks("a", run_on_block<2, one, two, three>)}), (Log{"one 0", "two 0", "three 0", "one 1", "two 1", "three 1"}));
  EXPECT_EQ(ran({{"a", {}, nullptr, run_once<2, all, state_alone>, nullptr, {}}}), (Log{"all", "state"}));
}

TEST(Stages, LinesOfOneNameRunBlockByBlockUnlessTheyLookBeside) {
  const Reach writes{Data::none, Data::none, Data::momenta}, own{Data::momenta, Data::none, Data::none},
      beside{Data::none, Data::momenta, Data::none};
  const auto first = on_blocks("a", run_on_block<2, one>, writes);
  EXPECT_EQ(ran({first, on_blocks("a", run_on_block<2, two>, own)}), (Log{"one 0", "two 0", "one 1", "two 1"}));
  EXPECT_EQ(ran({first, on_blocks("a", run_on_block<2, two>, beside)}), (Log{"one 0", "one 1", "two 0", "two 1"}));
  EXPECT_EQ(ran({first, on_blocks("b", run_on_block<2, two>, own)}), (Log{"one 0", "one 1", "two 0", "two 1"}));
  // What does not run parts nothing; what runs once does.
  EXPECT_EQ(ran({first, {"a", {}, never, run_once<2, all>, nullptr, {}}, on_blocks("a", run_on_block<2, two>, own)}),
            (Log{"one 0", "two 0", "one 1", "two 1"}));
  EXPECT_EQ(ran({first, {"a", {}, nullptr, run_once<2, all>, nullptr, {}}, on_blocks("a", run_on_block<2, two>, own)}),
            (Log{"one 0", "one 1", "all", "two 0", "two 1"}));
  // Three in a row, of which the last looks beside at what the first writes.
  EXPECT_EQ(ran({first, on_blocks("a", run_on_block<2, three>, own), on_blocks("a", run_on_block<2, two>, beside)}),
            (Log{"one 0", "three 0", "one 1", "three 1", "two 0", "two 1"}));
}

TEST(Stages, ConditionsHold) {
  EXPECT_EQ(ran({on_blocks("a", run_on_block<2, one>, {}, never), on_blocks("a", run_on_block<2, three>)}), (Log{"three 0", "three 1"}));
  EXPECT_EQ(ran({on_blocks("a", run_on_block<2, run_where<2, holds, one>, run_where<2, fails, two>>)}), (Log{"one 0", "one 1"}));
}

TEST(Stages, ASeriesRunsForEveryTermBeyondTheFirst) {
  const std::vector<Stage<2>> lines = {{"a", {}, nullptr, nullptr, nullptr, {on_blocks("a", run_on_block<2, count_term>)}},
                                       on_blocks("b", run_on_block<2, three>)};
  EXPECT_EQ(ran(lines, 0), (Log{"three 0", "three 1"}));
  EXPECT_EQ(ran(lines, 1), (Log{"three 0", "three 1"}));
  EXPECT_EQ(ran(lines, 3), (Log{"term 2 0", "term 2 1", "term 3 0", "term 3 1", "three 0", "three 1"}));
}

TEST(Stages, TimeIsBookedByName) {
  S state;
  W work;
  M model;
  work.blocks.list.resize(1);
  const std::vector<Stage<2>> lines = {on_blocks("a", run_on_block<2, three>), on_blocks("b", run_on_block<2, three>),
                                       on_blocks("a", run_on_block<2, three>), on_blocks("never", run_on_block<2, three>, {}, never)};
  run_stages(lines, state, work, model);
  run_stages(lines, state, work, model);
  ASSERT_EQ(work.phases.size(), 2u);
  EXPECT_EQ(work.phases[0].name, "a");
  EXPECT_EQ(work.phases[1].name, "b");
  EXPECT_GE(work.phases[0].seconds, 0);
}

/// What a step begins with, and what only a line of it can have made.
template <int Dim>
void look_at(const std::vector<Stage<Dim>>& stages, Data& made, std::set<std::string>& names) {
  for (const Stage<Dim>& s : stages) {
    names.insert(s.name);
    EXPECT_EQ((s.once != nullptr) + (s.on_block != nullptr) + !s.series.empty(), 1) << s.name;
    const Data takes = s.reach.reads | s.reach.beside;
    for (std::uint32_t bit = 0; bit < 21; ++bit) {
      const auto one_of = static_cast<Data>(1u << bit);
      EXPECT_TRUE(!meet(takes, one_of) || meet(made, one_of)) << s.name << " reads data " << bit << " before a line has written it";
    }
    EXPECT_TRUE(!s.once || s.reach.beside == Data::none) << s.name << ": what runs once has no blocks beside";
    made = made | s.reach.writes;
    if (!s.series.empty()) look_at(s.series, made, names);
  }
}

TEST(Stages, OfTheStepReadWhatIsThere) {
  using enum Data;
  Data made = order | motion | stress | slip | cracks | tractions | contacts | rigid | prescribed;
  std::set<std::string> names;
  look_at(stages<2, LinearShape>(), made, names);
  EXPECT_EQ(names, (std::set<std::string>{"account loads",
                                          "begin",
                                          "close the step",
                                          "contact and boundaries",
                                          "contact and boundaries again",
                                          "crack tractions",
                                          "face loads",
                                          "filter velocities",
                                          "find contact",
                                          "fracture",
                                          "lead positions",
                                          "move cracks",
                                          "move rigid bodies",
                                          "prescribe",
                                          "project momentum",
                                          "re-order particles",
                                          "remember contacts",
                                          "stress and forces",
                                          "stress and positions",
                                          "update momenta",
                                          "update velocities",
                                          "velocity fields"}));
  Data in_space = order | motion | stress | slip | cracks | tractions | contacts | rigid | prescribed;
  names.clear();
  look_at(stages<3, BsplineShape>(), in_space, names);
  EXPECT_EQ(made, in_space);
}

}  // namespace
}  // namespace crampon
