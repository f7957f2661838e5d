/// Faces held by prescribed velocities: a body moves there as prescribed, whatever the shape functions, and the reaction is the rate at which
/// the face changes the momentum of the particles.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double E = 5e6, rho = 1000, g = 9.81;  // Pa, kg/m3, m/s2; a bar of 1 m gets longer by 1 mm under its weight

struct Held {
  std::string shape_functions;
  int dim;
  int axis;            ///< along which the bar hangs, down from 1 m; it is two cells wide
  std::string region;  ///< of nodes at 1 m
  int cells;
};
void PrintTo(const Held& h, std::ostream* out) {
  *out << h.shape_functions << ", " << h.dim << "D along "
       << "xyz"[h.axis] << ", " << h.region << ", " << h.cells << " cells";
}

std::string point(const Held& h, double along, double across) {
  std::string text = "[";
  for (int k = 0; k < h.dim; ++k) text += fmt::format("{}{}", k > 0 ? ", " : "", k == h.axis ? along : across);
  return text + "]";
}

/// The bar lies from 0 to `top`; `more` follows.
std::string bar(const Held& h, double top, double end, const std::string& method, const std::string& more) {
  const double cell = 1. / h.cells;
  const char* box = h.dim == 3 ? "box" : "rectangle";
  return fmt::format(R"in(
analysis = "{}"
[grid]
origin = {}
size = {}
cell = {}
[time]
end = {}
courant = 0.4
[method]
shape_functions = "{}"
{}
[[material]]
name = "m"
law = "elastic_small_strain"
E = {}
nu = 0
density = {}
[[body]]
name = "bar"
material = "m"
shape = {{ kind = "{}", low = {}, high = {} }}
{})in",
                     h.dim == 3 ? "three_dimensional" : "plane_stress", point(h, -4 * cell, -4 * cell),
                     point(h, (h.cells + 10) * cell, 10 * cell), cell, end, h.shape_functions, method, E, rho, box, point(h, 0, 0),
                     point(h, top, 2 * cell), more);
}

std::string boundary(const Held& h, const std::string& name, double low, double high, double wide, const std::string& velocity) {
  const double cell = 1. / h.cells;
  return fmt::format("[[boundary]]\nname = \"{}\"\nregion = {{ kind = \"{}\", low = {}, high = {} }}\n{}\n", name,
                     h.dim == 3 ? "box" : "rectangle", point(h, low, -wide * cell), point(h, high, (2 + wide) * cell), velocity);
}

/// Not of a rigid body?
bool of_bar(const PointFrame& frame, std::size_t particle) { return field(frame, "body").values[particle] == 0; }

/// A rigid body that prescribes its velocity from `low` to `high`.
std::string rigid_boundary(const Held& h, double low, double high, const std::string& velocity) {
  const double cell = 1. / h.cells;
  return fmt::format("[[rigid]]\nname = \"top\"\nrole = \"boundary\"\nshape = {{ kind = \"{}\", low = {}, high = {} }}\n{}\n",
                     h.dim == 3 ? "box" : "rectangle", point(h, low, -cell), point(h, high, 3 * cell), velocity);
}

class HeldBar : public testing::TestWithParam<Held> {};

/// u = -rho g/E (L z - z^2/2), z from the held face; the mean over what hangs from it, and over the last quarter of the time.
TEST_P(HeldBar, HangsFromTheFace) {
  const Held& h = GetParam();
  const double cell = 1. / h.cells, c = std::sqrt(E / rho), period = 4 / c;
  std::string velocity = "vx = 0\nvy = 0\n";
  if (h.dim == 3) velocity += "vz = 0\n";
  double top = 1;
  std::string held;
  if (h.region == "row") held = boundary(h, "top", 1, 1, 1, velocity);
  if (h.region == "row of the body's width") held = boundary(h, "top", 1, 1, 0, velocity);
  if (h.region == "all beyond") held = boundary(h, "top", 1, 1 + 2 * cell, 1, velocity);
  if (h.region == "grip") held = boundary(h, "top", 1, 1 + 3 * cell, 1, velocity), top = 1 + 2 * cell;
  if (h.region == "line")
    held = fmt::format("[[boundary]]\nname = \"top\"\nregion = {{ kind = \"line\", from = {}, to = {} }}\n{}\n", point(h, 1, -cell),
                       point(h, 1, 3 * cell), velocity);
  // The row nearest to the edge of a rigid body holds the face.
  if (h.region == "rigid") held = rigid_boundary(h, 1, 1 + 3 * cell, "");
  if (h.region == "rigid with its edge in a cell") held = rigid_boundary(h, 1 - 0.4 * cell, 1 + 2.7 * cell, "");
  if (h.region == "rigid and thin") held = rigid_boundary(h, 1, 1 + 0.4 * cell, "");
  if (h.region == "rigid grip") held = rigid_boundary(h, 1, 1 + 3 * cell, ""), top = 1 + 2 * cell;
  std::string weight = "[";
  for (int k = 0; k < h.dim; ++k) weight += fmt::format("{}{}", k > 0 ? ", " : "", k == h.axis ? -g : 0.);
  const auto simulation = make(bar(h, top, 8 * period, fmt::format("damping = {}\nbody_force = {}]", 1.5 * 6.2832 / period, weight), held));
  const PointFrame start = simulation->particles({"displacement"});
  double expected = 0, sum = 0, reaction = 0;
  int count = 0;
  for (std::size_t p = 0; p < start.positions.size() / 3; ++p) {
    const double z = 1 - start.positions[3 * p + static_cast<std::size_t>(h.axis)];
    if (z > 0 && of_bar(start, p)) expected -= rho * g / E * (z - 0.5 * z * z);
  }
  run(*simulation, [&](Simulation& s) {
    if (s.time() < 6 * period || s.steps_done() % 7 != 0) return;
    const PointFrame now = s.particles({"displacement"});
    for (std::size_t p = 0; p < start.positions.size() / 3; ++p) {
      const std::size_t i = 3 * p + static_cast<std::size_t>(h.axis);
      if (start.positions[i] < 1 && of_bar(start, p)) sum += field(now, "displacement").values[i];
    }
    reaction += value(s, fmt::format("reaction_{}.top", "xyz"[h.axis]));
    ++count;
  });
  const double ratio = sum / count / expected;
  RecordProperty("ratio", fmt::format("{:.4f}", ratio));
  // The error of the cells. Held by their row alone, B-splines read 1.45, with all nodes beyond prescribed 1.09.
  EXPECT_NEAR(ratio, 1, 0.06 / h.cells);
  const double across = 2 * cell;
  EXPECT_NEAR(reaction / count, rho * g * top * across * (h.dim == 3 ? across : 1), 0.01 * rho * g * across * (h.dim == 3 ? across : 1));
}

std::vector<Held> bars() {
  std::vector<Held> out;
  for (const char* shape : all_shape_functions()) {
    for (const char* region : {"row", "row of the body's width", "all beyond", "grip", "rigid", "rigid grip"}) {
      out.push_back({shape, 2, 0, region, 10});
      out.push_back({shape, 2, 1, region, 10});
    }
    for (const char* region : {"line", "rigid with its edge in a cell", "rigid and thin"}) out.push_back({shape, 2, 1, region, 10});
    out.push_back({shape, 3, 2, "rigid", 10});
    out.push_back({shape, 2, 1, "row", 20});
    out.push_back({shape, 3, 2, "row of the body's width", 10});
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Sweep, HeldBar, testing::ValuesIn(cases_for(Runs::every, bars())));
INSTANTIATE_TEST_SUITE_P(SweepFull, HeldBar, testing::ValuesIn(cases_for(Runs::full, bars())));

class HeldFace : public testing::TestWithParam<Held> {};

/// A bar between two grips that speed up, shear and stretch it, under weight and load: in every step its momentum changes by what all of these
/// bring, and the energy balance closes.
TEST_P(HeldFace, ReactionIsTheRateOfMomentum) {
  const Held& h = GetParam();
  const double cell = 1. / h.cells;
  const std::string top = h.region == "rigid"
                              ? rigid_boundary(h, 1, 1 + 2 * cell,
                                               std::string("velocity = [{ expression = \"20*t\" }, { expression = \"3-9*t\" }") +
                                                   (h.dim == 3 ? ", 2]\nspin = [1, 0, 2]" : "]\nspin = [2]"))
                              : boundary(h, "top", 1, 1 + 2 * cell, 1,
                                         h.dim == 3 ? "vx = { expression = \"20*t*x\" }\nvy = { expression = \"3-9*t\" }\nvz = 2"
                                                    : "vx = { expression = \"20*t*x+y\" }\nvy = { expression = \"3-9*t\" }");
  const std::string more =
      top + boundary(h, "bottom", 0, 0, 1, std::string("vx = 0\nvy = { expression = \"-1+50*t\" }\n") + (h.dim == 3 ? "vz = 0" : "")) +
      "[[load]]\nname = \"push\"\nkind = \"force_each\"\nvalue = " + (h.dim == 3 ? "[3, 2, -1]" : "[3, 2]") + "\n";
  const std::string weight = h.dim == 3 ? "[-20, 30, 10]" : "[-20, 30]";
  const auto simulation = make(bar(h, 1, 0.02, "body_force = " + weight, more));
  const PointFrame start = simulation->particles({"mass"});
  double mass = 0;
  double count = 0;
  for (std::size_t p = 0; p < start.positions.size() / 3; ++p)
    if (of_bar(start, p)) mass += field(start, "mass").values[p], ++count;
  const std::array<double, 3> given{-20 * mass + 3 * count, 30 * mass + 2 * count, 10 * mass - count};
  std::array<double, 3> before{};
  double worst = 0, time = 0, largest = 0;
  run(*simulation, [&](Simulation& s) {
    for (int k = 0; k < h.dim; ++k) {
      const char axis = "xyz"[k];
      const double reaction = value(s, fmt::format("reaction_{}.top", axis)) + value(s, fmt::format("reaction_{}.bottom", axis));
      const double now = value(s, fmt::format("momentum_{}", axis));
      const auto i = static_cast<std::size_t>(k);
      worst = std::fmax(worst, std::fabs(now - before[i] - (given[i] + reaction) * (s.time() - time)) / mass);
      largest = std::fmax(largest, std::fabs(now) / mass);
      before[i] = now;
    }
    time = s.time();
  });
  RecordProperty("worst", fmt::format("{:.2e}", worst));
  EXPECT_GT(largest, 0.5);
  EXPECT_LT(worst, 1e-13);  // m/s; round-off
  const double closure = std::fabs(value(*simulation, "energy_closure")) / std::fabs(value(*simulation, "boundary_work"));
  RecordProperty("closure", fmt::format("{:.2e}", closure));
  EXPECT_LT(closure, 0.03);  // of the work, from the sudden start: linear functions, which see nothing beyond the faces, have 0.02
}
INSTANTIATE_TEST_SUITE_P(Sweep, HeldFace, testing::ValuesIn(for_all_shape_functions<Held>([](const char* shape) {
                           return std::vector<Held>{{shape, 2, 0, "", 10},
                                                    {shape, 2, 1, "", 10},
                                                    {shape, 3, 2, "", 10},
                                                    {shape, 2, 1, "rigid", 10},
                                                    {shape, 3, 2, "rigid", 10}};
                         })));

class HeldBeam : public testing::TestWithParam<Held> {};

/// A cantilever of 1 m x 0.2 m bends under its weight: Timoshenko's beam (shear coefficient 5/6).
TEST_P(HeldBeam, BendsFromTheFace) {
  const Held& h = GetParam();
  const double depth = 0.2, cell = depth / h.cells, weight = 0.2;
  const double slowest = 3.516 * std::sqrt(E / rho) * depth / std::sqrt(12.);  // rad/s
  const double y = h.region == "row" ? depth : 0;
  const auto simulation = make(fmt::format(R"in(
analysis = "plane_stress"
[grid]
origin = [{}, {}]
size = [{}, {}]
cell = {}
[time]
end = {}
courant = 0.4
[method]
shape_functions = "{}"
damping = {}
body_force = [0, -{}]
[[material]]
name = "m"
law = "elastic_small_strain"
E = {}
nu = 0
density = {}
[[body]]
name = "beam"
material = "m"
shape = {{ kind = "rectangle", low = [0, 0], high = [1, {}] }}
[[boundary]]
region = {{ kind = "rectangle", low = [0, {}], high = [0, {}] }}
vx = 0
vy = 0
[[probe]]
name = "tip"
point = [1, {}]
quantity = "displacement"
)in",
                                           -4 * cell, -4 * cell, (5 * h.cells + 8) * cell, (h.cells + 8) * cell, cell, 20 / slowest,
                                           h.shape_functions, 2 * slowest, weight, E, rho, depth, -y, depth + y, depth / 2));
  double sum = 0;
  int count = 0;
  run(*simulation, [&](Simulation& s) {
    if (s.time() < 16 / slowest) return;
    sum += value(s, "tip.displacement_y");
    ++count;
  });
  const double q = rho * weight * depth, I = depth * depth * depth / 12, x = 1 - cell / 4;
  const double expected = -q * (x * x * x * x - 4 * x * x * x + 6 * x * x) / (24 * E * I) - q * (x - x * x / 2) / (5. / 6 * E / 2 * depth);
  const double ratio = sum / count / expected;
  RecordProperty("ratio", fmt::format("{:.4f}", ratio));
  EXPECT_NEAR(ratio, 1, 0.02);  // of four cells over the depth; held by their row alone, uGIMP read 1.03, B-splines 1.32 to 1.49
}
INSTANTIATE_TEST_SUITE_P(Sweep, HeldBeam, testing::ValuesIn(for_all_shape_functions<Held>([](const char* shape) {
                           return std::vector<Held>{{shape, 2, 0, "row", 4}, {shape, 2, 0, "row of the body's width", 4}};
                         })));

}  // namespace
}  // namespace crampon::test
