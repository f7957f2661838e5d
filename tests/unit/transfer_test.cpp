/// What a pack of particles exchanges with nodes (step/packs.hpp, shape/separable.hpp) against sums over nodes, one pair after another.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "crampon/shape/registry.hpp"
#include "crampon/step/packs.hpp"

namespace crampon::test {
namespace {

template <int D, class S>
struct Case {
  static constexpr int dim = D;
  using Shape = S;
};

template <class C>
class TransferOf : public testing::Test {};
template <class... Shapes>
testing::Types<Case<2, Shapes>..., Case<3, Shapes>...> cases_of(ShapeList<Shapes...>);
using Cases = decltype(cases_of(ShapeFunctions{}));
TYPED_TEST_SUITE(TransferOf, Cases);

enum class Pairs { own_nodes, told };  ///< by targets

/// A tile of random records, and four particles about one node or about four.
template <int Dim, class Shape>
struct Sample {
  using T = Tile<Dim, Shape>;
  std::vector<Pack> records;
  std::vector<NodalVector<Dim>> vectors;
  StencilFactors<Dim, Shape> factors;
  std::vector<PairTarget> own;  ///< the targets that all pairs have anyway
  Pack record[lanes], stress[stress_size<Dim>], volume;

  Sample(unsigned seed, bool together) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> draw(-1, 1);
    const auto pack = [&] { return Pack{draw(random), draw(random), draw(random), draw(random)}; };
    for (int i = 0; i < T::nodes; ++i) {
      records.push_back(pack());
      vectors.push_back(leading<Dim>(pack()));
    }
    for (Pack& q : record) q = pack();
    for (Pack& q : stress) q = pack();
    volume = pack();
    Grid<Dim> grid;
    HalfSize<Dim> half_size;
    Pack x[Dim];
    for (int k = 0; k < Dim; ++k) {
      grid.cell[k] = std::ldexp(0.5, k);
      grid.inverse_cell[k] = std::ldexp(2., -k);
      half_size[k] = k == 2 ? 0.125 : 0.25;
      const double in_cell = 0.5 - Shape::bin_shift;  // about the middle of a cell, or about a node
      for (int l = 0; l < lanes; ++l) x[k][l] = grid.cell[k] * ((together ? 3 : 2 + l) + in_cell + 0.49 * draw(random));
    }
    if constexpr (Shape::has_domains) {
      DomainEdges<Dim> edges;
      for (int j = 0; j < Dim; ++j) {
        for (int k = 0; k < Dim; ++k) edges.r[j][k] = splat(j == k ? half_size[k] : 0.1 * draw(random));
      }
      factors.compute(x, grid, {}, edges);
    } else {
      factors.compute(x, grid, {}, half_size);
    }
    for (int l = 0; l < lanes; ++l) {
      for (const int step : T::steps) own.push_back({static_cast<std::uint16_t>(factors.base[l] + step), 0, 0});
    }
  }

  /// f(tile node, S, G, lane) for all pairs.
  template <class F>
  void for_pairs(F f) const {
    for (int l = 0; l < lanes; ++l) {
      for (int n = 0; n < T::stencil; ++n) {
        Vec<Dim> G;
        for (int k = 0; k < Dim; ++k) G[k] = factors.slope(n, k, l);
        f(static_cast<std::size_t>(factors.base[l] + T::steps[n]), factors.weight(n, l), G, l);
      }
    }
  }
  /// -V0 tau, component c k of lane l.
  double force(int c, int k, int l) const {
    static constexpr int plane[2][2] = {{0, 2}, {2, 1}}, space[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    if constexpr (Dim == 2) {
      return -volume[l] * stress[plane[c][k]][l];
    } else {
      return -volume[l] * stress[space[c][k]][l];
    }
  }
};

template <class V>
double difference(V a, V b, int components) {
  double worst = 0;
  for (int c = 0; c < components; ++c) worst = std::fmax(worst, std::fabs(a[c] - b[c]));
  return worst;
}

/// Sums of at most 4 x 64 products of numbers up to 1 (weights) or 4 (slopes per metre).
constexpr double round_off = 1e-13;

template <int Dim, class Shape>
void expect_sums_over_nodes(unsigned seed, bool together, Pairs pairs) {
  const Sample<Dim, Shape> c(seed, together);
  ASSERT_EQ(c.factors.same_base, together);
  const Stencil<Dim, Shape> stencil(c.factors);
  const PairTarget* targets = pairs == Pairs::told ? c.own.data() : nullptr;
  auto records = c.records, expected_records = c.records;
  auto vectors = c.vectors, expected_vectors = c.vectors;
  double expected_L[Dim][Dim][lanes] = {};
  c.for_pairs([&](std::size_t node, double S, const Vec<Dim>& G, int l) {
    expected_records[node] += c.record[l] * S;
    for (int d = 0; d < Dim; ++d) {
      for (int k = 0; k < Dim; ++k) {
        expected_vectors[node][d] += c.force(d, k, l) * G[k];
        expected_L[d][k][l] += c.vectors[node][d] * G[k];
      }
    }
  });
  const std::vector<Pack> no_offsets(2);  // [0]: of pairs that no moving face folds; without a [1] the compiler warns
  scatter<Dim, Shape>(stencil, targets, no_offsets.data(), c.record, records.data());
  scatter_force<Dim, Shape>(stencil, targets, c.volume, c.stress, vectors.data());
  Pack L[Dim * Dim];
  gradient<Dim, Shape>(stencil, targets, no_offsets.data(), c.vectors.data(), L);
  for (std::size_t i = 0; i < records.size(); ++i) {
    ASSERT_LT(difference(records[i], expected_records[i], 4), round_off);
    ASSERT_LT(difference(vectors[i], expected_vectors[i], Dim), round_off);
    if constexpr (Dim == 3) {
      ASSERT_EQ(vectors[i][3], 0);
    }
  }
  for (int d = 0; d < Dim; ++d) {
    for (int k = 0; k < Dim; ++k) {
      for (int l = 0; l < lanes; ++l) ASSERT_NEAR(L[d * Dim + k][l], expected_L[d][k][l], round_off);
    }
  }
}

TYPED_TEST(TransferOf, AreSumsOverNodes) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    for (const bool together : {true, false}) {
      for (const Pairs pairs : {Pairs::own_nodes, Pairs::told}) {
        expect_sums_over_nodes<TypeParam::dim, typename TypeParam::Shape>(seed, together, pairs);
        if (this->HasFatalFailure()) FAIL() << "seed " << seed << (together ? ", together" : ", apart");
      }
    }
  }
}

template <class Shape>
class SeparableSumsOf : public testing::Test {};
template <class... Members>
testing::Types<Members...> types_of(ShapeList<Members...>);
using Shapes = decltype(types_of(ShapeFunctions{}));
TYPED_TEST_SUITE(SeparableSumsOf, Shapes);

TYPED_TEST(SeparableSumsOf, Interpolate) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Sample<3, TypeParam> c(seed, seed % 2 == 0);
    const Stencil<3, TypeParam> stencil(c.factors);
    Pack expected[lanes] = {};
    c.for_pairs([&](std::size_t node, double S, const Vec<3>&, int l) { expected[l] += c.records[node] * S; });
    for (int l = 0; l < lanes; ++l) {
      const Pack* lowest = &c.records[static_cast<std::size_t>(c.factors.base[l])];
      ASSERT_LT(difference(SeparableSums<TypeParam>(stencil).interpolate(l, [&](int node) { return lowest[node]; }), expected[l], 4),
                round_off);
    }
  }
}

}  // namespace
}  // namespace crampon::test
