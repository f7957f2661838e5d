// Frames of the engine's particles and cracks.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "crampon/output/crack_tips.hpp"
#include "crampon/run/crack_quantities.hpp"
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

// A plate under tension with a notch that grows and a flaw that does not.
const char* const notched = R"(
analysis = "plane_strain"
[grid]
origin = [0, 0]
size = [24, 28]
cell = 1
[time]
steps = 40
[method]
shape_functions = "gimp"
[[material]]
name = "elastic"
law = "elastic_small_strain"
E = 100
nu = 0.3
density = 1
[[body]]
name = "plate"
material = "elastic"
shape = { kind = "rectangle", low = [2, 2], high = [22, 26] }
initial_stress = { kind = "components", xx = 0, yy = 1, xy = 0 }
[[load]]
name = "top"
kind = "traction"
face = "y+"
value = [0, 1]
[[load]]
name = "bottom"
kind = "traction"
face = "y-"
value = [0, -1]
[[crack]]
name = "notch"
points = [[0, 16], [8, 16]]
)";
const char* const growth = "growth = { criterion = { law = \"critical_j\", toughness = 0.02 } }\n";
const char* const flaw = "[[crack]]\nname = \"flaw\"\npoints = [[13, 10], [18, 10]]\n";

TEST(Sample, CracksHoldWhatIsKnownOfTheirTips) {
  const auto simulation = test::make(std::string(notched) + growth + flaw + "[fracture]\n");
  const CrackFrame start = simulation->cracks();
  test::run(*simulation);
  const CrackFrame frame = simulation->cracks();
  const std::vector<FrameTip> tips = tips_of(frame);
  ASSERT_EQ(tips.size(), 3u) << "the start of the notch lies outside";
  EXPECT_EQ(tips[0].status, TipStatus::grows);
  EXPECT_EQ(tips[1].status, TipStatus::waits);
  const auto count = static_cast<std::size_t>(frame.begin.back());
  for (const FrameTip& tip : tips) {
    const std::string name = frame.names[tip.crack] + "." + tip.end();
    EXPECT_EQ(tip.vertex, static_cast<std::size_t>(tip.at_end ? frame.begin[tip.crack + 1] - 1 : frame.begin[tip.crack]));
    for (const char* quantity : {"J", "J_far", "J_across", "K_I", "K_II", "phase"}) {
      const double found = value_at(frame, quantity, tip.vertex);
      EXPECT_TRUE(std::isfinite(found)) << quantity << " of " << name;
      EXPECT_EQ(found, test::value(*simulation, std::string(quantity) + "." + name));
    }
  }
  EXPECT_GT(value_at(frame, "grown", tips[0].vertex), 0);
  EXPECT_EQ(value_at(frame, "grown", tips[0].vertex), test::value(*simulation, "grown.notch.end"));
  EXPECT_EQ(value_at(frame, "grown", tips[1].vertex), 0);
  const std::vector<HistoryColumn> columns = simulation->history_columns();
  EXPECT_TRUE(std::none_of(columns.begin(), columns.end(), [](const HistoryColumn& c) { return c.name == "grown.flaw.end"; }));
  for (const CrackQuantity& q : crack_quantities()) {
    for (std::size_t v = 0; v < count; ++v) {
      const bool is_tip = std::any_of(tips.begin(), tips.end(), [&](const FrameTip& tip) { return tip.vertex == v; });
      if (q.name == "R") continue;  // of cracks with a traction law
      const bool expected = q.in == CrackFrames::all || (q.in == CrackFrames::with_fracture && is_tip);
      EXPECT_EQ(std::isfinite(value_at(frame, q.name, v)), expected) << q.name << " at " << v;
    }
  }

  // What was there at the start is found again.
  const auto before = vertices_before(frame, 0, start);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->first, 0u);
  EXPECT_EQ(before->second, static_cast<std::size_t>(start.begin[1] - 1));
  EXPECT_LT(before->second, tips[0].vertex);
  const auto all_of_flaw = vertices_before(frame, 1, start);
  ASSERT_TRUE(all_of_flaw);
  EXPECT_EQ(all_of_flaw->first, tips[1].vertex);
  EXPECT_EQ(all_of_flaw->second, tips[2].vertex);
  EXPECT_FALSE(vertices_before(frame, 0, CrackFrame{})) << "it was not there";
}

TEST(Sample, CracksWithoutFractureHaveNoTips) {
  const auto simulation = test::make(notched);
  const CrackFrame frame = simulation->cracks();
  EXPECT_TRUE(tips_of(frame).empty());
  ASSERT_EQ(frame.fields.size(), 2u);
  EXPECT_EQ(frame.fields[0].name, "opening");
  EXPECT_EQ(frame.fields[1].name, "sliding");
}

}  // namespace
}  // namespace crampon
