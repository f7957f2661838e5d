/// The inner pieces of a step one by one, on data that stays in the first-level cache (Google Benchmark): what each costs at best. A pack is
/// four particles. kernels --benchmark_filter=TEXT chooses.

#include <array>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "crampon/contact/law.hpp"
#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/contact/laws/rate_weakening.hpp"
#include "crampon/contact/node_solve.hpp"
#include "crampon/contact/normal.hpp"
#include "crampon/crack/crossing.hpp"
#include "crampon/input/read_problem.hpp"
#include "crampon/shape/registry.hpp"
#include "crampon/step/packs.hpp"

namespace crampon {
namespace {

using benchmark::ClobberMemory;
using benchmark::DoNotOptimize;
using benchmark::State;

std::mt19937_64& engine() {
  static std::mt19937_64 e;
  return e;
}
double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine()); }
template <int Dim>
Vec<Dim> draw_vector() {
  Vec<Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = draw(-1, 1);
  return v;
}

template <class... F>
void add([[maybe_unused]] const std::string& name, [[maybe_unused]] const F&... f) {
#ifndef __clang_analyzer__  // which takes the registry for a leak
  benchmark::RegisterBenchmark(name.c_str(), f...);
#endif
}

// ---- Packs and nodes ------------------------------------------------------------------------------------------------------------------

enum class Places { one_cell, anywhere };

/// A pack somewhere in the first block of a grid with cells of 1 m.
template <int Dim, class Shape>
struct OnePack {
  Pack x[Dim];
  Grid<Dim> grid;
  IndexVector<Dim> first_node{};
  HalfSize<Dim> half_size;
  StencilFactors<Dim, Shape> factors;

  explicit OnePack(Places places) {
    Vec<Dim> origin, cell;
    IndexVector<Dim> cells;
    cells.fill(block_side);
    half_size.fill(.25);
    for (int k = 0; k < Dim; ++k) {
      cell[k] = 1;
      for (int l = 0; l < lanes; ++l) x[k][l] = places == Places::one_cell ? draw(4.6, 4.9) : draw(0, block_side);
    }
    grid = Grid<Dim>(origin, cell, cells);
    compute();
  }
  void compute() { factors.compute(x, grid, first_node, half_size); }
  Stencil<Dim, Shape> stencil() const { return Stencil<Dim, Shape>(factors); }
};

template <int Dim, class Shape>
void factors(State& state) {
  OnePack<Dim, Shape> pack(Places::one_cell);
  for (auto _ : state) {
    DoNotOptimize(pack.x);
    pack.compute();
    DoNotOptimize(pack.factors);
  }
}

template <int Dim, class Shape>
void scatter_momentum(State& state, Places places) {
  const OnePack<Dim, Shape> pack(places);
  std::vector<Pack> tile(Tile<Dim, Shape>::nodes, splat(0.));
  Pack record[lanes];
  for (Pack& r : record) r = Pack{draw(0, 1), draw(0, 1), draw(0, 1), draw(0, 1)};
  for (auto _ : state) {
    scatter<Dim, Shape>(pack.stencil(), nullptr, nullptr, record, tile.data());
    ClobberMemory();
  }
}

template <int Dim, class Shape>
void velocity_gradient(State& state, Places places) {
  const OnePack<Dim, Shape> pack(places);
  const std::vector<NodalVector<Dim>> velocity(Tile<Dim, Shape>::nodes, splat_as<NodalVector<Dim>>(1.));
  Pack L[Dim * Dim];
  for (auto _ : state) {
    gradient<Dim, Shape>(pack.stencil(), nullptr, nullptr, velocity.data(), L);
    DoNotOptimize(L);
    ClobberMemory();
  }
}

template <int Dim, class Shape>
void scatter_forces(State& state, Places places) {
  const OnePack<Dim, Shape> pack(places);
  std::vector<NodalVector<Dim>> tile(Tile<Dim, Shape>::nodes, splat_as<NodalVector<Dim>>(0.));
  Pack stress[stress_size<Dim>];
  for (Pack& s : stress) s = Pack{draw(0, 1), draw(0, 1), draw(0, 1), draw(0, 1)};
  for (auto _ : state) {
    scatter_force<Dim, Shape>(pack.stencil(), nullptr, splat(1.), stress, tile.data());
    ClobberMemory();
  }
}

template <int Dim, class Shape>
void add_transfers(const char* shape) {
  const auto name = [&](const char* what, const char* where) { return fmt::format("{}/{}d/{}{}", what, Dim, shape, where); };
  add(name("factors of a pack", ""), factors<Dim, Shape>);
  for (const auto& [places, where] : {std::pair{Places::one_cell, "/one cell"}, std::pair{Places::anywhere, "/anywhere"}}) {
    add(name("scatter of a pack", where), scatter_momentum<Dim, Shape>, places);
    add(name("gradient of a pack", where), velocity_gradient<Dim, Shape>, places);
    add(name("forces of a pack", where), scatter_forces<Dim, Shape>, places);
  }
}

// ---- Laws -----------------------------------------------------------------------------------------------------------------------------

/// One pack, sheared to and fro by very little.
template <int Dim>
void update_stress(State& state, const MaterialSpec& law) {
  const int history_size = law->history_size(Dim);
  Pack stress[stress_size<Dim>], L[Dim * Dim];
  std::vector<Pack> history(static_cast<std::size_t>(history_size));
  law->initialise(Dim, stress, history.data());
  for (Pack& l : L) l = splat(draw(-1, 1));
  StressBatch<Dim> batch{1, 1e-6, L, stress, history.data(), history_size};
  for (auto _ : state) {
    DoNotOptimize(law->update(Dim == 2 ? StressState::plane_strain : StressState::three_dimensional, batch));
    batch.dt = -batch.dt;
    ClobberMemory();
  }
}

/// The law as an input would name it.
MaterialSpec material(const std::string& law) {
  return read_problem_text(
             fmt::format("[grid]\norigin = [0, 0]\nsize = [8, 8]\ncell = 1\n[time]\nsteps = 1\n"
                         "[[material]]\nname = \"m\"\nlaw = \"{}\"\nE = 100\nnu = 0.33\ndensity = 1.5\n"
                         "[[body]]\nname = \"b\"\nmaterial = \"m\"\nshape = {{ kind = \"rectangle\", low = [2, 2], high = [4, 4] }}\n",
                         law),
             "kernels")
      .materials.at(0)
      .law;
}

// ---- Cracks and contact ---------------------------------------------------------------------------------------------------------------

/// Particles to the nine nodes around, beside a straight crack.
void crossing(State& state) {
  const std::vector<Vec<2>> vertices{{{-2, .1}}, {{2, .2}}};
  const std::vector<Facet<2>> facets = path_facets(vertices.size());
  const std::vector<FacetNeighbours<2>> neighbours = find_neighbours<2>(facets, vertices.size());
  const CrackMesh<2> crack{vertices, facets, neighbours};
  std::vector<Vec<2>> nodes;
  for (int n = 0, row = 0; n < 9; ++n, row = n / 3) nodes.push_back({{-1. + n % 3, -1. + row}});
  const FacetRef facet{};
  Crossing<2> crossings[9];
  for (auto _ : state) {
    cross_stencil<2>(crack, {&facet, 1}, {{.3, .4}}, nodes, crossings);
    DoNotOptimize(crossings);
  }
  state.SetItemsProcessed(state.iterations() * 9);
}

/// Of two bodies with 4 particles per cell in 2D, 8 in 3D, that meet at a node along a slanted face.
template <int Dim>
void contact_normal(State& state) {
  std::vector<LabelledPoint<Dim>> points;
  Vec<Dim> cell;
  for (int k = 0; k < Dim; ++k) cell[k] = 1;
  for (int n = 0; n < power(4, Dim); ++n) {
    LabelledPoint<Dim> point;
    for (int k = 0, rest = n; k < Dim; ++k, rest /= 4) point.x[k] = -.75 + .5 * (rest % 4);
    point.side = point.x[0] + .3 * point.x[1] < 0 ? ContactSide::a : ContactSide::b;
    points.push_back(point);
  }
  for (auto _ : state) DoNotOptimize(logistic_regression_normal<Dim>(points, cell));
}

void friction(State& state, const ContactLawSpec& law) {
  const Sliding sliding{1, 2, 1, 1e-3, 1, .1};
  for (auto _ : state) DoNotOptimize(law->limit(sliding));
}

/// Two fields that approach and slide.
template <int Dim>
void solve_node(State& state) {
  const ContactLawSpec law = CoulombContact{.3};
  ContactRules rules;
  rules.task = ContactTask::four;
  rules.dt = 1e-3;
  std::array<ContactGroup<Dim>, 2> start;
  for (auto& group : start) group.m = draw(1, 2), group.p = draw_vector<Dim>();
  ContactPair<Dim> pair;
  pair.a = only(0), pair.b = only(1);
  pair.name.crack = 0;
  pair.law = &*law;
  pair.n[0] = start[1].p[0] * start[0].m < start[0].p[0] * start[1].m ? 1 : -1;
  pair.gap = -1;
  for (auto _ : state) {
    auto groups = start;
    auto solved = pair;
    DoNotOptimize(solve_contact<Dim>(rules, groups.data(), 2, &solved, 1));
    DoNotOptimize(groups);
  }
}

void add_all() {
  add_transfers<2, LinearShape>("linear");
  add_transfers<2, GimpShape>("gimp");
  add_transfers<2, BsplineShape>("bspline");
  add_transfers<3, LinearShape>("linear");
  add_transfers<3, GimpShape>("gimp");
  add_transfers<3, BsplineShape>("bspline");
  for (const Alternative& alternative : materials().alternatives()) {
    const std::string name = alternative.record->name();
    const MaterialSpec law = material(name);
    add("law of a pack/2d/" + name, update_stress<2>, law);
    add("law of a pack/3d/" + name, update_stress<3>, law);
  }
  add("crossing of nine lines/2d", crossing);
  add("contact normal by logistic regression/2d", contact_normal<2>);
  add("contact normal by logistic regression/3d", contact_normal<3>);
  add("friction/coulomb", friction, ContactLawSpec{CoulombContact{.3}});
  add("friction/rate weakening", friction, ContactLawSpec{RateWeakeningContact{.3, .5, .1, 0}});
  add("node with two fields/2d", solve_node<2>);
  add("node with two fields/3d", solve_node<3>);
}

}  // namespace
}  // namespace crampon

int main(int argc, char** argv) {
  crampon::add_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
