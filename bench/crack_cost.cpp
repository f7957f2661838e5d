/// What cracks cost (N03 section 3.5): the same elastic block without a crack, with one of half its width and with twenty, stepped in
/// turns within one run, so that only ratios count and a change of the machine's speed hits all alike.
///
///   crack_cost [--particles 400000] [--steps 40] [--threads 1] [--shape linear] [--update usf]

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "crampon/input/read_problem.hpp"
#include "crampon/run/simulation.hpp"

namespace {

std::string block(int cells, const std::string& shape, const std::string& update, const std::string& cracks) {
  return fmt::format(R"toml(
[grid]
origin = [0, 0]
size = [{0}, {0}]
cell = 1
[time]
steps = 1000000
courant = 0.2
[method]
shape_functions = "{1}"
stress_update = "{2}"
[[material]]
name = "elastic"
law = "elastic_small_strain"
E = 100
nu = 0.33
density = 1.5
[[body]]
name = "block"
material = "elastic"
shape = {{ kind = "rectangle", low = [2, 2], high = [{3}, {3}] }}
velocity = [{{ expression = "0.01*sin(0.01*x)" }}, {{ expression = "0.01*cos(0.013*y)" }}]
{4})toml",
                     cells, shape, update, cells - 2, cracks);
}

std::string crack(double x0, double x1, double y) {
  return fmt::format("[[crack]]\npoints = [[{}, {}], [{}, {}]]\ncontact = {{ law = \"coulomb\", friction = 0.3 }}\n", x0, y, x1, y + 0.01);
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, std::string> option = {
      {"--particles", "400000"}, {"--steps", "40"}, {"--threads", "1"}, {"--shape", "linear"}, {"--update", "usf"}};
  for (int i = 1; i + 1 < argc; i += 2) option[argv[i]] = argv[i + 1];
  const int cells = static_cast<int>(std::lround(std::sqrt(std::stod(option["--particles"]) / 4))) + 4,
            steps = std::stoi(option["--steps"]);
  const double W = cells - 4;

  std::string twenty;
  for (int k = 0; k < 20; ++k)
    twenty += crack(2 + W * (0.05 + 0.24 * (k % 4)), 2 + W * (0.15 + 0.24 * (k % 4)), 2.3 + W * (0.1 + 0.2 * (k / 4)));
  struct Case {
    const char* name;
    std::string cracks;
    std::unique_ptr<crampon::Simulation> simulation;
    std::vector<double> seconds;
  };
  std::vector<Case> cases;
  cases.push_back({"no crack", "", nullptr, {}});
  cases.push_back({"one crack of half the width", crack(2 + 0.25 * W, 2 + 0.75 * W, 2.3 + 0.5 * W), nullptr, {}});
  cases.push_back({"twenty cracks of a tenth", twenty, nullptr, {}});
  for (Case& c : cases) {
    c.simulation = crampon::Simulation::create(
        crampon::read_problem_text(block(cells, option["--shape"], option["--update"], c.cracks), "bench"), std::stoi(option["--threads"]));
    c.simulation->step(HUGE_VAL);  // sorts the particles
  }
  for (int s = 0; s < steps; ++s) {
    for (Case& c : cases) {
      const double start = cpu_seconds();
      c.simulation->step(HUGE_VAL);
      c.seconds.push_back(cpu_seconds() - start);
    }
  }
  const auto median = [](std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
    return v[v.size() / 2];
  };
  const double particles = static_cast<double>(cases[0].simulation->size().particles), base = median(cases[0].seconds);
  fmt::print("{:.0f} particles, {} shape functions, {}, {} thread(s), {} steps of each in turns\n\n", particles, option["--shape"],
             option["--update"], option["--threads"], steps);
  fmt::print("| case | CPU ns per particle-step, median (least) | ratio of medians |\n|---|---|---|\n");
  for (const Case& c : cases) {
    fmt::print("| {} | {:.1f} ({:.1f}) | {:.3f} |\n", c.name, median(c.seconds) / particles * 1e9,
               *std::min_element(c.seconds.begin(), c.seconds.end()) / particles * 1e9, median(c.seconds) / base);
  }
}
