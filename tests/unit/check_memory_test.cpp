#include "crampon/run/check_memory.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "crampon/geometry/rough_measure.hpp"
#include "crampon/geometry/round.hpp"
#include "run_case.hpp"

// A problem that memory cannot hold is refused from its input alone, at once, with the figure and the place.
namespace crampon {
namespace {

std::string block(const std::string& cell, const std::string& more = "") {
  return R"([grid]
origin = [0, 0]
size = [1, 1]
cell = )" +
         cell + R"(
[time]
end = 0.01
[[material]]
name = "soft"
law = "neo_hookean"
E = 1e5
nu = 0.3
density = 1000
[[body]]
name = "block"
material = "soft"
shape = { kind = "disk", centre = [0.5, 0.5], radius = 0.4 }
)" + more;
}

std::string refusal(const std::string& text, double available) {
  const Problem problem = read_problem_text(text, "in.toml");
  const auto start = std::chrono::steady_clock::now();
  try {
    check_memory(problem, available);
  } catch (const InputError& error) {
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1.);
    EXPECT_EQ(error.diagnostics().size(), 1U);
    return error.what();
  }
  return "";
}

TEST(CheckMemory, RefusesWhatDoesNotFit) {
  constexpr double available = 16e9;
  EXPECT_EQ(refusal(block("1e-3"), available), "");
  // pi 0.4^2 / 1e-10 cells with four particles each: 2.01e10, found to half a per cent.
  const std::string said = refusal(block("1e-5"), available);
  EXPECT_EQ(said.rfind("in.toml:16:1: body[0].shape: the body \"block\" comes to about 2.02e+10 particles (the problem needs about ", 0),
            0U)
      << said;
  EXPECT_NE(said.find("GB of memory, and 16 GB are free); use larger cells, fewer particles_per_cell or a smaller body"), std::string::npos)
      << said;
  EXPECT_EQ(refusal(block("1e-3", "particles_per_cell = 64\n"), available).rfind("in.toml:17:1: body[0].particles_per_cell: ", 0), 0U);
  // A few particles on very many cells.
  std::string sparse = block("1e-7");
  sparse.replace(sparse.find("radius = 0.4"), 12, "radius = 1e-5");
  EXPECT_EQ(refusal(sparse, available).rfind("in.toml:4:1: grid.cell: the grid has 1e+14 cells", 0), 0U);
  const std::string held = "[[boundary]]\nvx = 0\nregion = { kind = \"everywhere\" }\n";
  std::string small = block("1e-5", held);
  small.replace(small.find("radius = 0.4"), 12, "radius = 1e-2");
  EXPECT_NE(refusal(small, available).find("boundary[0]: the conditions hold about 1e+10 nodes"), std::string::npos)
      << refusal(small, available);
  EXPECT_NE(refusal(block("1e-5"), 1e15).find("no more than 4294967294 can be numbered"), std::string::npos);
}

TEST(CheckMemory, EstimateIsNearWhatIsThere) {
  for (const char* cell : {"0.01", "0.004"}) {
    const Problem problem = read_problem_text(block(cell), "in.toml");
    const SimulationSize size = Simulation::create(problem, 1)->size();
    const MemoryNeed need = estimate_memory(problem);
    // The sum of a shape's measure over some thousand boxes, and the stairs at its edge.
    EXPECT_NEAR(need.particles.at(0) / static_cast<double>(size.particles), 1, 0.03) << cell;
    // Nodes are kept in whole blocks of 8 cells, which the estimate leaves out.
    EXPECT_LT(need.total(), 1.1 * size.memory_bytes) << cell;
    EXPECT_GT(need.total(), 0.5 * size.memory_bytes) << cell;
  }
  EXPECT_GT(free_memory_bytes(), 1e6);
}

TEST(CheckMemory, RoughMeasureOfShapes) {
  const Bounds3 box{{{0, 0, 0}}, {{1, 1, 1}}};
  EXPECT_NEAR(rough_measure(Disk({{0.5, 0.5}}, 0.4), 2, box), 0.16 * M_PI, 0.01 * 0.16 * M_PI);
  EXPECT_NEAR(rough_measure(Disk({{0, 0}}, 0.4), 2, box), 0.04 * M_PI, 0.01 * 0.04 * M_PI) << "the part within the box";
  EXPECT_NEAR(rough_measure(Disk({{0.5, 0.5}}, 0.4), 3, box), 0.16 * M_PI, 0.06 * 0.16 * M_PI) << "a prism in space";
  EXPECT_EQ(rough_measure(Disk({{5, 5}}, 0.4), 2, box), 0);
}

TEST(CheckMemory, EndlessRunsAreRefused) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& settings) -> std::string {
    try {
      Simulation::create(read_problem_text(text, "in.toml", ".", settings), 1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refused(block("0.1"), {"time.end=1e30"}).find("time.end: 1e+30 s take 2.9e+32 time steps (waves in \"soft\" run at 11.6 m/s"),
            std::string::npos)
      << refused(block("0.1"), {"time.end=1e30"});
  EXPECT_NE(refused(block("0.1"), {"material[0].density=1e-40"}).find("time steps (waves in \"soft\""), std::string::npos);
  EXPECT_NE(refused(block("0.1"), {"time.step=1e-30"}).find("(the time step is 1e-30 s); correct end or step"), std::string::npos);
  EXPECT_NE(refused(block("0.1"), {"material[0].density=1e-300"}).find("material[0].density: 1e-300 kg/m3 cannot be computed with"),
            std::string::npos);
  EXPECT_NE(refused(block("0.1"), {"time.end=0"}).find("time.end: 0 s is out of bounds"), std::string::npos);
}

}  // namespace
}  // namespace crampon
