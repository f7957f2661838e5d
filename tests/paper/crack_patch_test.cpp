/// The crack patch test of N03 section 3.1 (validation row 1): every particle of the full specimen with an explicit crack does what it
/// does in the half model with a symmetry plane, at every step.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

struct PatchCase {
  const char* stress_update;
  const char* shape_functions;
  double tip_mm;     ///< distance of the tip from the loaded end
  bool from_right;   ///< the crack enters from the right
  bool turned;       ///< the whole problem turned by 90 degrees
  double vertex_mm;  ///< spacing of the crack's vertices
};

void PrintTo(const PatchCase& c, std::ostream* out) {
  *out << c.stress_update << ", " << c.shape_functions << ", tip at " << c.tip_mm << " mm";
}

std::string name_of(const testing::TestParamInfo<PatchCase>& info) {
  const PatchCase& c = info.param;
  return fmt::format("{}_{}_tip{:.0f}_{}{}_{:.0f}", c.stress_update, c.shape_functions, 10 * c.tip_mm, c.from_right ? "right" : "left",
                     c.turned ? "_turned" : "", 10 * c.vertex_mm);
}

/// Points of the specimen in its own axes (along, across) in mm, placed in the plane.
struct Placement {
  const PatchCase& c;
  std::string point(double along, double across) const {
    if (c.from_right) along = 100 - along;
    return c.turned ? fmt::format("[\"{} mm\", \"{} mm\"]", -across, along) : fmt::format("[\"{} mm\", \"{} mm\"]", along, across);
  }
  std::string rectangle(double along0, double across0, double along1, double across1) const {
    const double a0 = c.from_right ? 100 - along1 : along0, a1 = c.from_right ? 100 - along0 : along1;
    return c.turned ? fmt::format("{{ kind = \"rectangle\", low = [\"{} mm\", \"{} mm\"], high = [\"{} mm\", \"{} mm\"] }}", -across1, a0,
                                  -across0, a1)
                    : fmt::format("{{ kind = \"rectangle\", low = [\"{} mm\", \"{} mm\"], high = [\"{} mm\", \"{} mm\"] }}", a0, across0,
                                  a1, across1);
  }
};

std::string input(const PatchCase& c, bool full) {
  const Placement place{c};
  std::string text = fmt::format(R"(
analysis = "plane_stress"
[grid]
origin = {}
size = {}
cell = "2 mm"
[time]
steps = 200
courant = 0.4
[method]
stress_update = "{}"
shape_functions = "{}"
[[material]]
name = "polymer"
law = "elastic_small_strain"
E = "0.1 MPa"
nu = 0.33
density = "1.5 g/cm3"
[[body]]
name = "specimen"
material = "polymer"
shape = {}
thickness = "1 mm"
)",
                                 c.turned ? R"(["-24 mm", "-6 mm"])" : R"(["-6 mm", "-24 mm"])",
                                 c.turned ? R"(["48 mm", "112 mm"])" : R"(["112 mm", "48 mm"])", c.stress_update, c.shape_functions,
                                 place.rectangle(0, full ? -18 : 0, 100, 18));
  const auto load = [&](const char* name, double across0, double across1, double force) {
    const std::string value = c.turned ? fmt::format("[\"{} mN\", 0]", -force) : fmt::format("[0, \"{} mN\"]", force);
    text += fmt::format("[[load]]\nname = \"{}\"\nkind = \"total_force\"\nregion = {}\nvalue = {}\n", name,
                        place.rectangle(0, across0, 1, across1), value);
  };
  load("upper", 0, 18, 0.4);
  if (full) {
    load("lower", -18, 0, -0.4);
    text += fmt::format(
        "[[crack]]\nname = \"crack\"\npoints = [{}, {}]\nmax_segment = \"{} mm\"\nfixed = true\ncontact = {{ law = \"none\" }}\n",
        place.point(-4, 0), place.point(c.tip_mm, 0), c.vertex_mm);
  } else {
    // The mirror is what the crack is not: from the tip on, away from the loaded end.
    const double tip = c.from_right ? 100 - c.tip_mm : c.tip_mm;
    const std::string part = c.turned ? fmt::format("[0, \"{} mm\"]", tip) : fmt::format("[\"{} mm\", 0]", tip);
    text += fmt::format("[[symmetry]]\nname = \"plane\"\naxis = \"{}\"\nat = 0\nside = \"{}\"\n{} = {}\n", c.turned ? "x" : "y",
                        c.turned ? "below" : "above", c.from_right ? "to" : "from", part);
  }
  return text;
}

/// Values of the particles of the upper arm, in the order of their ids, which is the same in both models.
std::vector<double> upper(const PatchCase& c, const PointFrame& start, const DataArray& f) {
  std::vector<double> out;
  const auto n = static_cast<std::size_t>(f.components);
  for (std::size_t i = 0; i < start.positions.size() / 3; ++i) {
    const double across = c.turned ? -start.positions[3 * i] : start.positions[3 * i + 1];
    for (std::size_t k = 0; across > 0 && k < n; ++k) out.push_back(f.values[n * i + k]);
  }
  return out;
}

class CrackPatch : public testing::TestWithParam<PatchCase> {};

TEST_P(CrackPatch, FullModelEqualsHalfModel) {
  const PatchCase& c = GetParam();
  const auto full = make(input(c, true)), half = make(input(c, false));
  const PointFrame full_start = full->particles(), half_start = half->particles();
  ASSERT_EQ(full_start.positions.size(), 2 * half_start.positions.size());
  double worst = 0;
  for (int step = 0; step < 200; ++step) {
    full->step(HUGE_VAL);
    half->step(HUGE_VAL);
    const PointFrame a = full->particles(), b = half->particles();
    for (const char* name : {"displacement", "velocity", "stress"}) {
      const std::vector<double> expected = upper(c, half_start, field(b, name));
      const double scale = largest(expected);
      const double apart = difference(upper(c, full_start, field(a, name)), expected);
      // USF has no stress yet after its first step.
      ASSERT_TRUE(step == 0 || scale > 0) << name << " at step " << step;
      worst = std::fmax(worst, scale > 0 ? apart / scale : apart);
    }
  }
  // Both do the same sums in another order: round-off, far below the 1e-10 that is asked for.
  EXPECT_LT(worst, 1e-10);
  RecordProperty("largest_relative_difference", fmt::format("{:.3g}", worst));
}

std::vector<PatchCase> cases() {
  std::vector<PatchCase> list;
  for (const char* shape : all_shape_functions()) {
    for (const char* update : {"usl", "musl", "usf", "usavg"}) list.push_back({update, shape, 50, false, false, 2});
    list.push_back({"usavg", shape, 51.3, false, false, 2.7});  // tip and vertices off nodes
    list.push_back({"usavg", shape, 50, true, false, 1});
    list.push_back({"usavg", shape, 51.3, true, false, 54});  // one segment
    list.push_back({"usavg", shape, 50, false, true, 2});
    list.push_back({"musl", shape, 48.7, true, true, 3.1});
  }
  return list;
}

INSTANTIATE_TEST_SUITE_P(N03, CrackPatch, testing::ValuesIn(cases()), name_of);

}  // namespace
}  // namespace crampon::test
