#include "crampon/core/units.hpp"

#include <clocale>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "crampon/core/formula.hpp"
#include "crampon/core/function.hpp"

namespace crampon {
namespace {

std::string message(const std::string& text, const std::string& unit) {
  try {
    const double value = parse_quantity(text, unit);
    return fmt::format("no error: {}", value);
  } catch (const UnitError& error) {
    return error.what + " (" + error.why + "); " + error.remedy;
  }
}

TEST(Units, PowersOfTenGiveTheBitsOfThePlainNumber) {
  EXPECT_EQ(parse_quantity("0.1 MPa", "Pa"), 100000.);
  EXPECT_EQ(parse_quantity("1.5 g/cm3", "kg/m3"), 1500.);
  EXPECT_EQ(parse_quantity("1 mm/ms", "m/s"), 1.);
  EXPECT_EQ(parse_quantity("30 1/s", "1/s"), 30.);
  EXPECT_EQ(parse_quantity("18mm", "m"), 0.018);
  EXPECT_EQ(parse_quantity("-.5e-3 km", "m"), -0.5);
  EXPECT_EQ(parse_quantity("+2.5e+3 N/mm2", "Pa"), 2.5e9);
  EXPECT_EQ(parse_quantity("1 µm", "m"), 1e-6);
  EXPECT_EQ(parse_quantity("5 %", "1"), 0.05);
  EXPECT_EQ(parse_quantity("5", "1"), 5.);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1e3, 1e3);
  for (int k = 0; k < 1000; ++k) {
    const std::string number = fmt::format("{:.7g}", uniform(random));
    if (number.find('e') == std::string::npos) {
      EXPECT_EQ(parse_quantity(number + " mm", "m"), std::stod(number + "e-3")) << number;
    }
  }
}

TEST(Units, OtherFactors) {
  // One multiplication by the unit's factor, itself rounded once or twice.
  const double eps = 4 * std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(parse_quantity("180 deg", "rad"), std::numbers::pi, eps * std::numbers::pi);
  EXPECT_NEAR(parse_quantity("60 rpm", "rad/s"), 2 * std::numbers::pi, 2 * eps * std::numbers::pi);
  EXPECT_EQ(parse_quantity("2 h", "s"), 7200.);
  EXPECT_EQ(parse_quantity("1 rad/s", "1/s"), 1.);
  EXPECT_NEAR(parse_quantity("20 degC", "K"), 293.15, 293.15 * eps);
}

TEST(Units, HalfPowers) {
  EXPECT_EQ(parse_quantity("2.5e3 MPa*sqrt(m)", "Pa*m^0.5"), 2.5e9);
  EXPECT_EQ(parse_quantity("1 MPa*m^0.5", "Pa*m^0.5"), 1e6);
  EXPECT_EQ(parse_quantity("1 MPa m^(1/2)", "Pa*m^0.5"), 1e6);
  EXPECT_EQ(parse_quantity("1 kPa sqrt(km2/m)", "Pa*m^0.5"), 1e6);
  const double eps = std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(parse_quantity("1 N/mm^1.5", "Pa*m^0.5"), 1e6 / std::sqrt(1000.), 1e5 * eps);
  EXPECT_NEAR(parse_quantity("1 MPa*sqrt(mm)", "Pa*m^0.5"), 1e6 * std::sqrt(1e-3), 1e5 * eps);
}

TEST(Units, AnyDimensionGoesToCoherentUnits) {
  EXPECT_EQ(parse_quantity("2 mm", "any"), 0.002);
  EXPECT_EQ(parse_quantity("2 mJ", "any"), 0.002);
  EXPECT_EQ(parse_quantity("2 kPa", "any"), 2000.);
  EXPECT_EQ(parse_quantity("7", "any"), 7.);
}

TEST(Units, EveryErrorNamesWhatIsExpected) {
  EXPECT_EQ(message("5 mm", "Pa"),
            "\"5 mm\" has the wrong dimension (a pressure is expected here); write it in MPa or another unit of that dimension");
  EXPECT_EQ(message("5 MPa", "Pa*m^0.5"),
            "\"5 MPa\" has the wrong dimension (a toughness is expected here); write it in MPa*sqrt(m) or another unit of that dimension");
  EXPECT_EQ(message("5 MPa*sqrt(m)", "Pa"),
            "\"5 MPa*sqrt(m)\" has the wrong dimension (a pressure is expected here); write it in MPa or another unit of that dimension");
  EXPECT_EQ(message("5 s", "1/s"),
            "\"5 s\" has the wrong dimension (a rate is expected here); write it in 1/s or another unit of that dimension");
  EXPECT_EQ(message("5 m", "1"), "\"5 m\" has the wrong dimension (a pure number is expected here); write the number alone");
  EXPECT_EQ(message("5", "Pa"),
            "\"5\" has no unit (a pressure is expected here); add the unit, or write the number without quotes when it is in Pa");
  EXPECT_EQ(message("5 foo", "m"),
            "\"5 foo\": unknown unit \"foo\" (a length is expected here); write it in mm or another unit of that dimension");
  EXPECT_EQ(message("5 m since 2", "m"),
            "\"5 m since 2\": unknown unit \"m since 2\" (a length is expected here); write it in mm or another unit of that dimension");
  EXPECT_EQ(message("1,5 mm", "m"), "\"1,5 mm\" has a decimal comma (numbers are written with a point); write it as \"1.5 mm\"");
  for (const std::string text : {"", "  ", "abc", "nan m", "inf m", "-", "+", "mm 5"})
    EXPECT_EQ(message(text, "m"),
              "\"" + text + "\" does not start with a number (a quantity is a number and a unit); write it as \"1.5 mm\"");
  EXPECT_EQ(message("1e999 m", "m"), "\"1e999 m\": the number does not fit (numbers reach from 1e-307 to 1e308); write another number");
}

TEST(Units, HostileUnitsAreRefused) {
  for (const std::string unit : {"sqrt(", "sqrt(((((", "m^", "m^0.3", "m^(1/0)", "m^(1/", "^0.5", "m^1e9", "sqrt(m))", "m/0.5^", "()^0.5",
                                 "sqrt()", "5^0.5", "m @ 5", "lg(re 1 mW)", "m^0.5 @ 2"})
    EXPECT_THROW(parse_quantity("1 " + unit, "m"), UnitError) << unit;
  std::string deep = "1 ";
  for (int k = 0; k < 10000; ++k) deep += "sqrt(";
  EXPECT_THROW(parse_quantity(deep, "m"), UnitError);
}

TEST(Units, FactorOfAUnit) {
  EXPECT_EQ(unit_factor("mm/s", "m/s"), 0.001);
  EXPECT_EQ(unit_factor("MPa", "Pa"), 1e6);
  EXPECT_EQ(unit_factor("", "1"), 1.);
  EXPECT_THROW(unit_factor("degC", "K"), UnitError);
  EXPECT_THROW(unit_factor("mm", "m/s"), UnitError);
  EXPECT_EQ(dimension_name("kg/m3"), "density");
  EXPECT_EQ(dimension_name("kg5"), "kg5");
}

TEST(Units, TheLocaleDoesNotMatter) {
  // A locale with a decimal comma, where one is installed; the default one otherwise.
  const char* const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"};
  for (const char* name : names)
    if (setlocale(LC_ALL, name)) break;
  EXPECT_EQ(parse_quantity("1.5 mm", "m"), 0.0015);
  EXPECT_NEAR(parse_quantity("1.5 deg", "rad"), 1.5 * std::numbers::pi / 180, 1e-17);
  EXPECT_EQ(ValueFunction::expression("1.5*t")(2, {}), 3.);
  setlocale(LC_ALL, "C");
}

TEST(ValueFunctions, ConstantsAndTables) {
  EXPECT_EQ(ValueFunction()(3, {{1, 2, 3}}), 0.);
  EXPECT_EQ(ValueFunction::constant(2)(3, {{1, 2, 3}}), 2.);
  const ValueFunction f = ValueFunction::table({1, 2, 4}, {10, 20, 0});
  EXPECT_EQ(f(0, {}), 10.);
  EXPECT_EQ(f(1.5, {}), 15.);
  EXPECT_EQ(f(2, {}), 20.);
  EXPECT_EQ(f(3, {}), 10.);
  EXPECT_EQ(f(9, {}), 0.);
  EXPECT_TRUE(f.depends_on_time());
  EXPECT_FALSE(f.depends_on_position());
  EXPECT_THROW(ValueFunction::table({1, 1}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(ValueFunction::table({2, 1}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(ValueFunction::table({1}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(ValueFunction::table({}, {}), std::invalid_argument);
  EXPECT_THROW(ValueFunction::table({0, std::nan("")}, {0, 0}), std::invalid_argument);
}

TEST(ValueFunctions, Expressions) {
  const Vec<3> x{{2, 3, 4}};
  EXPECT_EQ(ValueFunction::expression("x + 10*y + 100*z + 1000*t")(5, x), 5432.);
  EXPECT_EQ(ValueFunction::expression("sin(pi*t)", 0.5)(0.5, x), 0.5);
  EXPECT_EQ(ValueFunction::expression("if(t < 1, x, y)")(0, x), 2.);
  EXPECT_EQ(ValueFunction::expression("if(t < 1, x, y)")(1, x), 3.);
  EXPECT_EQ(ValueFunction::expression("t == 1 ? 7 : 8")(1, x), 7.);
  EXPECT_TRUE(ValueFunction::expression("x*t").depends_on_time());
  EXPECT_TRUE(ValueFunction::expression("x*t").depends_on_position());
  EXPECT_FALSE(ValueFunction::expression("x").depends_on_time());
  EXPECT_FALSE(ValueFunction::expression("t").depends_on_position());
  for (const char* bad : {"", "  ", "t = 3", "foo", "1, 2", "(1", "sin(", "t +", "\"a\"", "t\n+1\x01", "x'"})
    EXPECT_THROW(ValueFunction::expression(bad), std::invalid_argument) << bad;
  EXPECT_THROW(ValueFunction::expression(std::string(3000, '1')), std::invalid_argument);
  try {
    ValueFunction::expression("1 + foo");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "Unexpected token \"foo\" found at position 4.");
    const auto* unknown = dynamic_cast<const UnknownVariable*>(&error);
    ASSERT_NE(unknown, nullptr);
    EXPECT_EQ(unknown->name, "foo");
  }
}

TEST(ValueFunctions, ManyThreadsSeeTheirOwnArguments) {
  const ValueFunction shared = ValueFunction::expression("x*t + y");
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      const ValueFunction copy = shared;
      for (int i = 0; i < 20000; ++i) {
        const double expected = double(i) * k + 3;
        wrong[k] += copy(k, {{double(i), 3, 0}}) != expected;
        wrong[k] += shared(k, {{double(i), 3, 0}}) != expected;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(Formulas, NameTheirVariables) {
  Formula f("2*reaction_y.top + (time > 1)*time", {"time", "reaction_y.top"});
  EXPECT_EQ(f(std::vector<double>{1, 3}), 6.);
  EXPECT_EQ(f(std::vector<double>{2, 3}), 8.);
  EXPECT_TRUE(f.uses("time"));
  EXPECT_FALSE(f.uses("t"));
  for (const char* good : {"t", "reaction_y.top", "_a1", "x.2"}) EXPECT_TRUE(is_formula_name(good)) << good;
  for (const char* bad : {"", "1a", ".a", "left-most", "a b", "\xc3\xa9"}) EXPECT_FALSE(is_formula_name(bad)) << bad;
  for (const char* bad : {"", "time = 2", "1, 2", "tame", "2*", "time\ntime"})
    EXPECT_THROW(Formula(bad, {"time"}), std::invalid_argument) << bad;
}

}  // namespace
}  // namespace crampon
