#include "crampon/run/check_memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "crampon/geometry/rough_measure.hpp"
#include "crampon/state/grid.hpp"
#include "crampon/state/particles.hpp"

namespace crampon {

namespace {

double cell_of(const GridInput& grid, std::size_t k) { return grid.cell.size() == 1 ? grid.cell[0] : grid.cell[k]; }

/// The grid as the box that shapes are cut to.
Bounds3 box_of(const Problem& problem) {
  Bounds3 box;
  for (std::size_t k = 0; k < static_cast<std::size_t>(problem.dimension()); ++k) {
    box.low[k] = problem.grid.origin[k];
    box.high[k] = box.low[k] + problem.grid.size[k];
  }
  return box;
}

double cell_measure(const Problem& problem) {
  double measure = 1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(problem.dimension()); ++k) measure *= cell_of(problem.grid, k);
  return measure;
}

/// The arrays of state/particles.hpp, twice: particles are copied when they are put in order.
template <int Dim>
double bytes_of_particle(int history, bool has_domains) {
  const double packs = motion_packs<Dim> + (2. + stress_size<Dim> + history + (has_domains ? domain_size<Dim> : 0)) / lanes;
  return 2 * (packs * sizeof(Pack) + 2 * sizeof(Vec<Dim>) + sizeof(std::uint32_t) + sizeof(std::uint16_t));
}

/// Nodes and tiles per cell that holds particles: momenta, forces, motion (state/nodes.hpp).
template <int Dim>
constexpr double bytes_of_active_cell = (Dim == 2 ? 5 : 9) * sizeof(Pack);

struct Filling {
  const Region* shape = nullptr;
  const std::vector<std::int64_t>* per_cell = nullptr;
  const MaterialLaw* law = nullptr;  ///< none: rigid
};

void add_body(const Problem& problem, const Filling& filling, MemoryNeed& need) {
  const int dim = problem.dimension();
  if (filling.shape == nullptr) {
    need.particles.push_back(0);
    need.bodies.push_back(0);
    return;
  }
  double per_cell = 1;
  for (int k = 0; k < dim; ++k)
    per_cell *=
        static_cast<double>(filling.per_cell->size() == 1 ? filling.per_cell->front() : (*filling.per_cell)[static_cast<std::size_t>(k)]);
  const double cells = rough_measure(*filling.shape, dim, box_of(problem)) / cell_measure(problem);
  const int history = filling.law != nullptr ? filling.law->history_size(dim) : 0;
  const bool has_domains = crampon::has_domains(problem.method.shape_functions);
  need.particles.push_back(cells * per_cell);
  need.bodies.push_back(cells * per_cell *
                            (dim == 2 ? bytes_of_particle<2>(history, has_domains) : bytes_of_particle<3>(history, has_domains)) +
                        cells * (dim == 2 ? bytes_of_active_cell<2> : bytes_of_active_cell<3>));
}

}  // namespace

double MemoryNeed::total() const { return std::accumulate(bodies.begin(), bodies.end(), grid + conditions); }

MemoryNeed estimate_memory(const Problem& problem) {
  const auto dim = static_cast<std::size_t>(problem.dimension());
  MemoryNeed need;
  double blocks = 1;
  for (std::size_t k = 0; k < dim; ++k) blocks *= std::floor(problem.grid.size[k] / cell_of(problem.grid, k) / block_side) + 3;
  need.grid = blocks * sizeof(std::uint32_t);  // Blocks::of_number
  for (const BoundaryInput& in : problem.boundaries)
    need.conditions += rough_measure(*in.region, problem.dimension(), box_of(problem)) / cell_measure(problem) * sizeof(std::int64_t);
  for (const SymmetryInput& in : problem.symmetries) {
    double nodes = 1;
    for (std::size_t k = 0; k < dim; ++k)
      nodes *= k == static_cast<std::size_t>(in.axis) ? 1 : problem.grid.size[k] / cell_of(problem.grid, k);
    need.conditions += nodes * sizeof(std::int64_t);
  }
  for (const BodyInput& in : problem.bodies) {
    Filling filling{in.shape.get(), &in.particles_per_cell, nullptr};
    for (const MaterialInput& material : problem.materials) {
      if (material.name == in.material) filling.law = material.law.get();
    }
    add_body(problem, filling, need);
  }
  for (const RigidInput& in : problem.rigids) add_body(problem, {in.shape.get(), &in.particles_per_cell, nullptr}, need);
  return need;
}

double free_memory_bytes() {
  double bytes = std::numeric_limits<double>::infinity();
  std::ifstream system("/proc/meminfo");
  for (std::string name, rest; system >> name && std::getline(system, rest);) {
    if (name == "MemAvailable:") bytes = std::stod(rest) * 1024;  // in kB
  }
  for (const char* of_group : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double limit = 0;
    if (std::ifstream(of_group) >> limit) bytes = std::fmin(bytes, limit);
  }
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) bytes = std::fmin(bytes, static_cast<double>(limit.rlim_cur));
  }
  return bytes;
}

void check_memory(const Problem& problem, double available) {
  const MemoryNeed need = estimate_memory(problem);
  const double particles = std::accumulate(need.particles.begin(), need.particles.end(), 0.);
  constexpr double most_particles = std::numeric_limits<std::uint32_t>::max() - 1.;  // their numbers, state/particles.hpp
  const bool too_many = particles > most_particles;
  if (need.total() <= available && !too_many) return;

  const std::string why = need.total() > available ? fmt::format("the problem needs about {:.4g} GB of memory, and {:.3g} GB are free",
                                                                 need.total() * 1e-9, available * 1e-9)
                                                   : fmt::format("no more than {:.0f} can be numbered", most_particles);
  const std::size_t largest = static_cast<std::size_t>(std::max_element(need.bodies.begin(), need.bodies.end()) - need.bodies.begin());
  const double of_largest = need.bodies.empty() ? 0 : need.bodies[largest];
  if (!too_many && need.grid > of_largest && need.grid > need.conditions) {
    double cells = 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(problem.dimension()); ++k)
      cells *= problem.grid.size[k] / cell_of(problem.grid, k);
    throw InputError(
        {{problem.grid.at("cell"), fmt::format("the grid has {:.3g} cells", cells), why, "use larger cells or a smaller grid"}});
  }
  if (!too_many && need.conditions > of_largest) {
    const Located& first =
        problem.boundaries.empty() ? static_cast<const Located&>(problem.symmetries.front()) : problem.boundaries.front();
    throw InputError({{first.location, fmt::format("the conditions hold about {:.3g} nodes", need.conditions / sizeof(std::int64_t)), why,
                       "use larger cells or smaller regions"}});
  }
  const bool rigid = largest >= problem.bodies.size();
  const Located& body = rigid ? static_cast<const Located&>(problem.rigids[largest - problem.bodies.size()]) : problem.bodies[largest];
  const std::string& name = rigid ? problem.rigids[largest - problem.bodies.size()].name : problem.bodies[largest].name;
  throw InputError({{body.at(body.keys.contains("particles_per_cell") ? "particles_per_cell" : "shape"),
                     fmt::format("the body \"{}\" comes to about {:.3g} particles", name, need.particles[largest]), why,
                     "use larger cells, fewer particles_per_cell or a smaller body"}});
}

}  // namespace crampon
