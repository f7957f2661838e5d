// Frames of the engine's particles.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "run_case.hpp"

namespace crampon {
namespace {

using test::field;

// Two bodies of particles of different sizes; the one on the left runs out of the grid.
const char* const parting = R"(
analysis = "plane_strain"
[grid]
origin = [0, 0]
size = [12, 6]
cell = 1
[time]
steps = 30
courant = 0.2
[method]
leaving_particle = "remove"
[[material]]
name = "elastic"
law = "elastic_small_strain"
E = 100
nu = 0.3
density = 1.5
[[body]]
name = "left"
material = "elastic"
shape = { kind = "rectangle", low = [1, 1], high = [3, 4] }
velocity = [-5, 0.3]
[[body]]
name = "right"
material = "elastic"
particles_per_cell = 3
shape = { kind = "rectangle", low = [7, 1], high = [9, 4] }
velocity = [0, 0.3]
)";

TEST(Sample, ParticlesStandInTheOrderOfTheirIdsAlsoWhenSomeHaveLeft) {
  const auto simulation = test::make(parting);
  const std::size_t all = 2 * 3 * 4 + 2 * 3 * 9;
  std::size_t least = all;
  const auto look = [&](const Simulation& s) {
    const PointFrame frame = s.particles({"volume"});
    const Numbers &id = field(frame, "id").values, &body = field(frame, "body").values;
    ASSERT_EQ(frame.positions.size(), 3 * id.size());
    least = std::min(least, id.size());
    for (std::size_t i = 0; i < id.size(); ++i) {
      ASSERT_TRUE(i == 0 || id[i - 1] < id[i]);
      ASSERT_EQ(body[i], id[i] < 2 * 3 * 4 ? 0 : 1);  // bodies are filled one after the other
      const double size = body[i] == 0 ? 1. / 2 : 1. / 3;
      ASSERT_DOUBLE_EQ(frame.particle_size[3 * i], size);
      ASSERT_DOUBLE_EQ(frame.particle_size[3 * i + 1], size);
      ASSERT_EQ(frame.positions[3 * i] < 5, body[i] == 0);
    }
  };
  look(*simulation);
  EXPECT_EQ(least, all);
  test::run(*simulation, look);
  EXPECT_EQ(least, 2u * 3 * 9) << "the body on the left has left column by column";
}

TEST(Sample, SinglePrecisionIsTheFullRounded) {
  const auto simulation = test::make(parting);
  for (int step = 0; step < 5; ++step) simulation->step(HUGE_VAL);
  const std::vector<std::string> names = simulation->particle_quantities();
  const PointFrame full = simulation->particles(names), single = simulation->particles(names, Precision::single);
  const auto expect_rounded = [](const Numbers& a, const Numbers& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(static_cast<float>(a[i]), b[i]);
  };
  expect_rounded(full.positions, single.positions);
  expect_rounded(full.particle_size, single.particle_size);
  ASSERT_EQ(full.fields.size(), names.size() + 2);
  for (std::size_t k = 0; k < full.fields.size(); ++k) expect_rounded(full.fields[k].values, single.fields[k].values);
  EXPECT_EQ(single.positions.type(), NumberType::float32);
}

}  // namespace
}  // namespace crampon
