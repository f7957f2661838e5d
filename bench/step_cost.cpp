/// What a step costs: inputs that take turns in one process, so that a change of the machine's speed hits all alike and ratios count.
/// Prints JSON, a list with an entry for each; bench/run makes a table of it.
///
///   step_cost [--threads N] [--seconds S] [--skip STEPS] CASE.toml|bare:KERNEL|machine:copying|machine:multiply-adds ...
///
/// What stands for particles with machine: are bytes and operations, of one core whatever N.
///
/// --skip: steps before measuring begins, 2 unless told, which sort the particles and touch the memory.

#include <ctime>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/baseline/kernel.hpp"
#include "bench/machine_work.hpp"
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

/// An input of the engine, or other work: a bare kernel, or what shows the machine's rates.
struct Contestant {
  std::string name;
  std::unique_ptr<Simulation> simulation{};
  std::function<void()> work{};
  double particles = 0;
  int steps = 0;                      ///< since measuring began
  std::vector<PhaseTime> before{};    ///< phases when measuring began
  std::vector<double> cpu{}, wall{};  ///< s per step, of each turn

  void step() {
    if (simulation) {
      simulation->step(HUGE_VAL);
    } else {
      work();
    }
    ++steps;
  }

  /// The first step of a turn is not timed: it finds the caches full of what others left there.
  void take_turn() {
    constexpr double long_enough = .01;  // s
    step();
    const double cpu_start = cpu_seconds(), wall_start = wall_seconds();
    const int first = steps;
    do step();
    while (wall_seconds() - wall_start < long_enough);
    cpu.push_back((cpu_seconds() - cpu_start) / (steps - first));
    wall.push_back((wall_seconds() - wall_start) / (steps - first));
  }
};

/// name: 2d-linear-usf-128, of 128 cells along each side.
std::unique_ptr<bench::Kernel> bare_kernel(const std::string& name, int threads) {
  static const std::regex form("([23])d-(linear|gimp)-(usf|usavg)-([0-9]+)");
  std::smatch part;
  if (!std::regex_match(name, part, form)) {
    throw std::invalid_argument("bare:" + name +
                                " is no bare kernel; bare:2d-linear-usf-128 is, as are 3d, gimp, usavg and other numbers of cells");
  }
  return (part[1] == "2" ? bench::make_block2d : bench::make_block3d)(
      std::stoi(part[4]), part[3] == "usf" ? bench::Scheme::usf : bench::Scheme::usavg,
      part[2] == "linear" ? bench::Stencil::linear : bench::Stencil::gimp, threads);
}

Contestant contestant(const std::string& name, int threads) {
  Contestant c{name};
  if (name.rfind("bare:", 0) == 0) {
    const std::shared_ptr<bench::Kernel> bare = bare_kernel(name.substr(5), threads);
    c.work = [bare] { bare->step(); };
    c.particles = static_cast<double>(bare->particles());
  } else if (name == "machine:copying") {
    c.work = [copying = std::make_shared<bench::Copying>()] { copying->step(); };
    c.particles = bench::Copying::bytes();
  } else if (name == "machine:multiply-adds") {
    c.work = [multiply_adds = std::make_shared<bench::MultiplyAdds>()] { multiply_adds->step(); };
    c.particles = bench::MultiplyAdds::operations();
  } else {
    c.simulation = Simulation::create(read_problem(name, {"time.steps=1000000000"}), threads);
    c.particles = static_cast<double>(c.simulation->size().particles);
  }
  return c;
}

/// Value below which a part of the values lies.
double quantile(std::vector<double> v, double part) {
  const auto at = v.begin() + std::lround(part * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), at, v.end());
  return *at;
}

/// Cost of a particle-step by that of the first contestant in the same round of turns: median and quartiles. CPU time for one thread; several wait.
nlohmann::ordered_json to_first(const Contestant& c, const Contestant& first, int threads) {
  std::vector<double> ratio;
  for (std::size_t k = 0; k < c.cpu.size(); ++k) {
    const double time = threads == 1 ? c.cpu[k] / first.cpu[k] : c.wall[k] / first.wall[k];
    ratio.push_back(time * first.particles / c.particles);
  }
  return {{"median", quantile(ratio, .5)}, {"quartiles", {quantile(ratio, .25), quantile(ratio, .75)}}};
}

nlohmann::ordered_json results(const Contestant& c, const Contestant& first, int threads) {
  const double to_ns = 1e9 / c.particles;
  nlohmann::ordered_json out = {{"name", c.name},
                                {"threads", threads},
                                {"particles", c.particles},
                                {"turns", c.cpu.size()},
                                {"steps", c.steps},
                                {"cpu_ns", quantile(c.cpu, .5) * to_ns},
                                {"cpu_ns_least", quantile(c.cpu, 0) * to_ns},
                                {"wall_ns", quantile(c.wall, .5) * to_ns},
                                {"to_first", to_first(c, first, threads)}};
  if (!c.simulation) return out;
  out["engine_bytes"] = c.simulation->size().memory_bytes / c.particles;
  for (const PhaseTime& phase : c.simulation->phases()) {
    double earlier = 0;
    for (const PhaseTime& p : c.before) earlier += p.name == phase.name ? p.seconds : 0;
    out["phases_ns"][phase.name] = (phase.seconds - earlier) / c.steps * to_ns;
  }
  return out;
}

int measure(const std::vector<std::string>& names, int threads, double seconds, int skip) {
  std::vector<Contestant> list;
  for (const std::string& name : names) list.push_back(contestant(name, threads));
  for (Contestant& c : list) {
    for (int k = 0; k < skip; ++k) c.step();
    if (c.simulation) c.before = c.simulation->phases();
    c.steps = 0;
  }
  const double end = wall_seconds() + seconds * static_cast<double>(list.size());
  do {
    for (Contestant& c : list) c.take_turn();
  } while (wall_seconds() < end || list[0].cpu.size() < 5);
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Contestant& c : list) out.push_back(results(c, list[0], threads));
  std::cout << out.dump(1) << "\n";
  return 0;
}

}  // namespace
}  // namespace crampon

int main(int argc, char** argv) {
  int threads = 1, skip = 2;
  double seconds = 2;
  std::vector<std::string> names;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "--threads" && i + 1 < argc) {
        threads = std::stoi(argv[++i]);
      } else if (word == "--seconds" && i + 1 < argc) {
        seconds = std::stod(argv[++i]);
      } else if (word == "--skip" && i + 1 < argc) {
        skip = std::stoi(argv[++i]);
      } else {
        names.push_back(word);
      }
    }
    if (names.empty())
      throw std::invalid_argument("no case; step_cost [--threads N] [--seconds S] [--skip STEPS] CASE.toml|bare:KERNEL|machine:WORK ...");
    return crampon::measure(names, threads, seconds, skip);
  } catch (const std::exception& error) {
    fmt::print(stderr, "step_cost: {}\n", error.what());
    return 2;
  }
}
