/// A disk with a crack in its middle, pressed together by two opposite forces (validation row 16): K_I and K_II at all angles between the crack and the forces.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run_case.hpp"

namespace crampon::test {
namespace {

using std::numbers::pi;

/// K_I and K_II over sigma_0 sqrt(pi a), sigma_0 = P/(pi R B), of a crack of half length a at an angle to the forces P: complex potentials, collocated to
/// 1e-7. Where K_I is negative it is that of faces that pass through each other.
struct Reference {
  double degrees, K_I, K_II;
};
constexpr Reference half[] = {{0, 1.3872, 0},        {10, 1.0553, 1.2091},  {15, 0.6929, 1.6703},  {20, 0.2624, 2.0012},
                              {23, -0.0099, 2.1379}, {25, -0.1925, 2.2052}, {27, -0.3738, 2.2548}, {30, -0.6403, 2.2991},
                              {45, -1.7948, 2.1197}, {90, -3.2211, 0}};
constexpr Reference third[] = {{0, 1.1677, 0},        {10, 0.9760, 0.8844}, {15, 0.7502, 1.2678},  {20, 0.4575, 1.5883},
                               {23, 0.2576, 1.7460},  {25, 0.1168, 1.8358}, {27, -0.0287, 1.9132}, {30, -0.2530, 2.0060},
                               {45, -1.3759, 2.0788}, {90, -3.0741, 0}};

struct Disk {
  double radius;  ///< over the half length of the crack: 2 or 3
  Reference reference;
  double cells;  ///< per half length of the crack
  const char* shape_functions = "linear";
  double aside = 0;  ///< of the grid along both axes, cells
};
void PrintTo(const Disk& d, std::ostream* out) {
  *out << fmt::format("a/R = 1/{}, {} degrees, {} cells, {}, grid {} aside", d.radius, d.reference.degrees, d.cells, d.shape_functions,
                      d.aside);
}
constexpr double E = 1, nu = 0.3, pressure = 1e-6;  // Pa
/// Are the faces pressed together all along? About the angle at which K_I is zero they touch in part.
bool is_closed(const Disk& d) { return d.reference.K_I < -0.1; }

/// The crack is turned, and the forces stand along y. Each is a pressure on one cell's width of the rim: the exact load is a mean of the table over the
/// angles that it spans, which is lower by alpha^2/6 |K''| for a half angle alpha, .0023 at most for a/R = 1/2 and ten cells.
std::string text_of(const Disk& d) {
  const double h = 1 / d.cells, angle = d.reference.degrees * pi / 180, x = std::sin(angle), y = std::cos(angle);
  const double cells = 2 * std::ceil(d.radius * d.cells) + 4;
  const double wave = std::sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)));
  // Damping near the critical one of the lowest vibration, an oval, whose period is about 5 radii over the speed of waves; at rest within 15 radii.
  return fmt::format(R"in(
analysis = "plane_strain"
[grid]
origin = [{low:.17g}, {low:.17g}]
size = [{size:.17g}, {size:.17g}]
cell = {h:.17g}
[time]
end = {end:.17g}
[method]
shape_functions = "{shape}"
damping = {damping:.17g}
[[material]]
name = "m"
law = "elastic_small_strain"
E = {E}
nu = {nu}
density = 1
[[body]]
name = "disk"
material = "m"
match_mass = true
shape = {{ kind = "disk", centre = [0, 0], radius = {R:.17g} }}
[[crack]]
name = "c"
points = [[{x0:.17g}, {y0:.17g}], [{x:.17g}, {y:.17g}]]
[[load]]
name = "top"
kind = "pressure"
region = {{ kind = "rectangle", low = [{w0:.17g}, 0], high = [{w:.17g}, {far:.17g}] }}
value = [{p}]
[[load]]
name = "bottom"
kind = "pressure"
region = {{ kind = "rectangle", low = [{w0:.17g}, -{far:.17g}], high = [{w:.17g}, 0] }}
value = [{p}]
[fracture]
mixity = "{mixity}"
[output]
history_every = {end:.17g}
)in",
                     fmt::arg("low", (d.aside - cells / 2) * h), fmt::arg("size", cells * h), fmt::arg("h", h),
                     fmt::arg("end", 15 * d.radius / wave), fmt::arg("shape", d.shape_functions), fmt::arg("damping", wave / d.radius),
                     fmt::arg("E", E), fmt::arg("nu", nu), fmt::arg("R", d.radius), fmt::arg("x0", -x), fmt::arg("y0", -y),
                     fmt::arg("x", x), fmt::arg("y", y), fmt::arg("w0", -h / 2), fmt::arg("w", h / 2), fmt::arg("far", d.radius + h),
                     fmt::arg("p", pressure),  // The interaction integral does not know of the pressure between faces.
                     fmt::arg("mixity", is_closed(d) ? "opening" : "interaction"));
}

class BrazilianDisk : public ::testing::TestWithParam<Disk> {};
// A tip parts material node by node: on a slanted path it acts up to .8 cells ahead of where it is drawn, and d(K_II sqrt(a))/d ln(a) is up to
// 2.2 sigma_0 sqrt(pi a) here. So .18 sigma_0 sqrt(pi a) at ten cells to the half length, and in proportion; row 16 asks for .03 at twenty.
TEST_P(BrazilianDisk, HasTheIntensitiesOfTheTable) {
  const Disk& d = GetParam();
  const auto s = make(text_of(d));
  run(*s);
  const double force = -value(*s, "load_y.top"), sigma_0 = force / (pi * d.radius), unit = sigma_0 * std::sqrt(pi);
  EXPECT_NEAR(force, pressure / d.cells, 1e-3 * force) << "the load is what is asked for";
  const double bar = 0.18 * 10 / d.cells, modulus = E / (1 - nu * nu);
  for (const char* tip : {"start", "end"}) {
    const auto of_tip = [&](const char* name) { return value(*s, fmt::format("{}.c.{}", name, tip)); };
    const double J = of_tip("J"), K_I = of_tip("K_I") / unit, K_II = of_tip("K_II") / unit;
    RecordProperty(fmt::format("{}", tip), fmt::format("{:.4f} {:.4f}", K_I, K_II));
    EXPECT_NEAR(K_II, -d.reference.K_II, bar) << tip;  // pressure between the faces does not change it: it presses alike on both
    EXPECT_NEAR(K_I, std::fmax(d.reference.K_I, 0), bar) << tip;
    // J of closed faces is that of sliding alone: without friction their pressure does no work.
    EXPECT_NEAR(std::sqrt(modulus * std::fmax(J, 0)) / unit, std::hypot(std::fmax(d.reference.K_I, 0), d.reference.K_II), bar) << tip;
  }
  if (is_closed(d)) {
    EXPECT_GT(value(*s, "opening_min.c"), -0.03 * value(*s, "sliding_max.c") - 1e-12 * force) << "faces do not pass through each other";
  }
}

std::vector<Disk> at_all_angles(double cells) {
  std::vector<Disk> all;
  for (const Reference& r : half) all.push_back({2, r, cells});
  for (const Reference& r : third) all.push_back({3, r, cells});
  return all;
}
/// Open, sliding alone, closed; other shape functions and places of the grid.
std::vector<Disk> some() {
  return {{2, half[0], 10}, {2, half[1], 10, "gimp"}, {2, half[3], 10, "linear", 0.5},
          {2, half[5], 10}, {2, half[8], 10},         {3, third[2], 10}};
}
INSTANTIATE_TEST_SUITE_P(Angles, BrazilianDisk, ::testing::ValuesIn(some()));
INSTANTIATE_TEST_SUITE_P(AnglesFull, BrazilianDisk, ::testing::ValuesIn(at_all_angles(20)));

}  // namespace
}  // namespace crampon::test
