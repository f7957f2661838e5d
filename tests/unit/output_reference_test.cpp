#include "crampon/run/output_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "run_case.hpp"

// What a run writes is described: every history column of every example and of a problem with one of each thing, with its unit.
namespace crampon {
namespace {

void expect_described(const Problem& problem, const std::string& where) {
  const auto simulation = Simulation::create(problem, 1);
  for (const HistoryColumn& column : simulation->history_columns()) {
    const ColumnDescription* is = find_description(column.name);
    ASSERT_NE(is, nullptr) << where << ": " << column.name << " is not in describe_history_columns()";
    const std::string& unit = is->unit.empty() ? column.unit : is->unit;
    EXPECT_EQ(unit, column.unit) << where << ": " << column.name;
    EXPECT_FALSE(is->meaning.empty()) << column.name;
    const bool is_of_probe = std::any_of(problem.probes.begin(), problem.probes.end(),
                                         [&](const ProbeInput& probe) { return column.name.starts_with(probe.name + "."); });
    EXPECT_EQ(is->pattern == "PROBE.QUANTITY", is_of_probe) << where << ": " << column.name;
  }
}

TEST(OutputReference, DescribesEveryHistoryColumn) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(CRAMPON_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() == ".toml") expect_described(read_problem(entry.path().string()), entry.path());
  }
  expect_described(read_problem_text(R"(
[grid]
origin = [0, 0]
size = [1, 1]
cell = 0.1
[time]
end = 0.01
[[material]]
name = "soft"
law = "elastic_small_strain"
E = 1e5
nu = 0.3
density = 1000
[[body]]
name = "block"
material = "soft"
shape = { kind = "rectangle", low = [0.3, 0.3], high = [0.7, 0.7] }
[[rigid]]
name = "tool"
shape = { kind = "rectangle", low = [0.3, 0.7], high = [0.7, 0.9] }
[[wall]]
name = "floor"
point = [0, 0.3]
normal = [0, 1]
[[crack]]
name = "notch"
points = [[0.3, 0.5], [0.5, 0.5]]
[[symmetry]]
name = "mirror"
axis = "x"
at = 0.3
[[boundary]]
name = "held"
vx = 0
region = { kind = "rectangle", low = [0.7, 0.3], high = [0.7, 0.7] }
[[load]]
name = "pull"
kind = "total_force"
region = { kind = "rectangle", low = [0.6, 0.3], high = [0.7, 0.7] }
value = [1, 0]
[[probe]]
name = "tip"
quantity = "stress"
point = [0.5, 0.5]
[method]
leaving_particle = "remove"
)",
                                     "test.toml", "."),
                   "one of each");
}

TEST(OutputReference, DescriptionsAreOfTheRightColumn) {
  EXPECT_EQ(find_description("momentum_y")->pattern, "momentum_AXIS");
  EXPECT_EQ(find_description("reaction_x.left edge")->pattern, "reaction_AXIS.NAME");
  EXPECT_EQ(find_description("load_y.pull")->pattern, "load_AXIS.NAME");
  EXPECT_EQ(find_description("left_momentum_x")->pattern, "left_momentum_AXIS");
  EXPECT_EQ(find_description("tip.velocity_x")->pattern, "PROBE.QUANTITY");
  EXPECT_EQ(find_description("momentum_w"), nullptr);
  EXPECT_EQ(find_description("energy"), nullptr);
}

TEST(OutputReference, PageHoldsAllQuantitiesAndColumns) {
  const std::string page = output_reference_page();
  for (const char* name : {"`velocity`", "`von_mises`", "`energy_density`", "`energy_closure`", "`reaction_AXIS.NAME`", "J/m3", "kg m2/s"})
    EXPECT_NE(page.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace crampon
