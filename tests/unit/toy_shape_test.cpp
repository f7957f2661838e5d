/// A further shape function is one file and one line: a toy, put among the others by tests/add_shape_function.py, is known to the parser, the schema
/// and the reference page. The tests of the family, which are compiled into this program with the longer list, test it without being told.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "crampon/input/read_problem.hpp"
#include "crampon/input/reference.hpp"
#include "crampon/input/schema.hpp"
#include "crampon/shape/registry.hpp"

namespace crampon::test {
namespace {

std::string input(const char* word) {
  return fmt::format(R"in(
[grid]
origin = [0, 0]
size = [8, 8]
cell = 1
[time]
steps = 1
[method]
shape_functions = "{}"
[[material]]
name = "m"
law = "neo_hookean"
E = 1
nu = 0
density = 1
[[body]]
name = "b"
material = "m"
shape = {{ kind = "rectangle", low = [2, 2], high = [4, 4] }}
)in",
                     word);
}

TEST(ToyShape, IsKnownToTheParser) {
  EXPECT_EQ(read_problem_text(input("toy"), "toy.toml", ".").method.shape_functions, kind_of<ToyShape>);
  try {
    read_problem_text(input("toi"), "toy.toml", ".");
    FAIL() << "accepted";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("\"toy\""), std::string::npos) << error.what();
  }
}

TEST(ToyShape, IsInTheSchema) {
  const auto schema = nlohmann::json::parse(json_schema());
  const std::string text = schema.dump();
  const auto at = text.find("\"shape_functions\"");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NE(text.find("\"toy\""), std::string::npos);
}

TEST(ToyShape, IsOnTheReferencePage) {
  const std::string page = reference_page();
  EXPECT_NE(page.find("`\"toy\"`"), std::string::npos);
  EXPECT_NE(page.find(ToyShape::help), std::string::npos);
}

TEST(ToyShape, IsTestedWithItsFamily) {
  int tests = 0;
  const auto& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    if (std::string(all.GetTestSuite(i)->name()).find("ShapeFunctionsOf/toy") == 0) tests += all.GetTestSuite(i)->total_test_count();
  }
  EXPECT_GE(tests, 14);  // seven in the plane, seven in space
}

}  // namespace
}  // namespace crampon::test
