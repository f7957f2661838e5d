/// What a step costs: inputs stepped in turns in one process, so that a change of the machine's speed hits all alike and ratios count.
/// Prints JSON, a list with an entry for each; bench/run makes a table of it.
///
///   step_cost [--threads N] [--seconds S] CASE.toml ...

#include <ctime>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crampon/input/read_problem.hpp"
#include "crampon/run/simulation.hpp"

namespace crampon {
namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Contestant {
  std::string name;
  double particles = 0, memory_bytes = 0;
  std::unique_ptr<Simulation> simulation;
  std::vector<double> cpu{}, wall{};  ///< s, of each step
};

Contestant contestant(const std::string& path, int threads) {
  Contestant c;
  c.name = path;
  c.simulation = Simulation::create(read_problem(path, {"time.steps=1000000000"}), threads);
  const SimulationSize size = c.simulation->size();
  c.particles = static_cast<double>(size.particles);
  c.memory_bytes = size.memory_bytes;
  return c;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

double least(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }

int measure(const std::vector<std::string>& names, int threads, double seconds) {
  std::vector<Contestant> list;
  for (const std::string& name : names) list.push_back(contestant(name, threads));
  std::vector<std::vector<PhaseTime>> before;
  for (Contestant& c : list) {
    for (int k = 0; k < 2; ++k) c.simulation->step(HUGE_VAL);  // sorts the particles and touches the memory
    before.push_back(c.simulation->phases());
  }
  const double end = wall_seconds() + seconds * static_cast<double>(list.size());
  do {
    for (Contestant& c : list) {
      const double cpu = cpu_seconds(), wall = wall_seconds();
      c.simulation->step(HUGE_VAL);
      c.cpu.push_back(cpu_seconds() - cpu);
      c.wall.push_back(wall_seconds() - wall);
    }
  } while (wall_seconds() < end || list[0].cpu.size() < 5);
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Contestant& c = list[i];
    const double to_ns = 1e9 / c.particles;
    nlohmann::ordered_json phases = nlohmann::ordered_json::object();
    for (const PhaseTime& phase : c.simulation->phases()) {
      double earlier = 0;
      for (const PhaseTime& p : before[i]) earlier += p.name == phase.name ? p.seconds : 0;
      phases[phase.name] = (phase.seconds - earlier) / static_cast<double>(c.wall.size()) * to_ns;
    }
    out.push_back({{"name", c.name},
                   {"threads", threads},
                   {"particles", c.particles},
                   {"steps", c.cpu.size()},
                   {"cpu_ns", median(c.cpu) * to_ns},
                   {"cpu_ns_least", least(c.cpu) * to_ns},
                   {"wall_ns", median(c.wall) * to_ns},
                   {"engine_bytes", c.memory_bytes / c.particles},
                   {"phases_ns", phases}});
  }
  std::cout << out.dump(1) << "\n";
  return 0;
}

}  // namespace
}  // namespace crampon

int main(int argc, char** argv) {
  int threads = 1;
  double seconds = 2;
  std::vector<std::string> names;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "--threads" && i + 1 < argc) {
        threads = std::stoi(argv[++i]);
      } else if (word == "--seconds" && i + 1 < argc) {
        seconds = std::stod(argv[++i]);
      } else {
        names.push_back(word);
      }
    }
    if (names.empty()) throw std::invalid_argument("no case; step_cost [--threads N] [--seconds S] CASE.toml ...");
    return crampon::measure(names, threads, seconds);
  } catch (const std::exception& error) {
    fmt::print(stderr, "step_cost: {}\n", error.what());
    return 2;
  }
}
