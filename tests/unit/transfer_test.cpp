/// Sums axis by axis against sums over nodes, with the weights of each node (shape/separable.hpp).

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "crampon/shape/bspline.hpp"
#include "crampon/shape/gimp.hpp"
#include "crampon/shape/separable.hpp"

namespace crampon::test {
namespace {

template <class Shape>
class SeparableSumsOf : public testing::Test {};
using Shapes = testing::Types<GimpShape, BsplineShape>;
TYPED_TEST_SUITE(SeparableSumsOf, Shapes);

/// A tile of random values, and four particles about one node or about four.
template <class Shape>
struct Sample {
  using T = Tile<3, Shape>;
  std::vector<Pack> tile;
  Stencil<3, Shape> stencil;
  Pack record[lanes];
  Pack columns[3][lanes];

  Sample(unsigned seed, bool together) : tile(T::nodes) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> draw(-1, 1);
    const auto pack = [&] { return Pack{draw(random), draw(random), draw(random), draw(random)}; };
    for (Pack& q : tile) q = pack();
    for (Pack& q : record) q = pack();
    for (auto& column : columns) {
      for (Pack& q : column) q = pack();
    }
    Grid<3> grid;
    grid.cell = {{0.5, 1, 2}};
    grid.inverse_cell = {{2, 1, 0.5}};
    Pack x[3];
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < lanes; ++l) x[k][l] = grid.cell[k] * ((together ? 3 : 2 + l) + 0.49 * draw(random));
    }
    stencil.compute(x, grid, {0, 0, 0}, {0.25, 0.25, 0.125});
  }

  /// f(tile index, S, G, lane) for all pairs.
  template <class F>
  void for_pairs(F f) const {
    for (int l = 0; l < lanes; ++l) {
      for (int n = 0; n < T::stencil; ++n) {
        Vec<3> G;
        for (int k = 0; k < 3; ++k) G[k] = stencil.slope(n, k, l);
        f(stencil.base[l] + T::steps[n], stencil.weight(n, l), G, l);
      }
    }
  }
};

double difference(Pack a, Pack b) {
  double worst = 0;
  for (int c = 0; c < 4; ++c) worst = std::fmax(worst, std::fabs(a[c] - b[c]));
  return worst;
}

/// Sums of 4 x 27 products of numbers up to 1 (weights: 4 per cell).
constexpr double round_off = 1e-13;

TYPED_TEST(SeparableSumsOf, AreThoseOverNodes) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const bool together = seed % 2 == 0;
    const Sample<TypeParam> c(seed, together);
    ASSERT_EQ(c.stencil.same_base, together);
    const SeparableSums<TypeParam> sums(c.stencil);
    std::vector<Pack> values = c.tile, slopes = c.tile, expected_values = c.tile, expected_slopes = c.tile;
    Pack at[lanes] = {}, gradient[lanes][3] = {};
    c.for_pairs([&](int node, double S, const Vec<3>& G, int l) {
      expected_values[static_cast<std::size_t>(node)] += c.record[l] * S;
      at[l] += c.tile[static_cast<std::size_t>(node)] * S;
      for (int k = 0; k < 3; ++k) {
        expected_slopes[static_cast<std::size_t>(node)] += c.columns[k][l] * G[k];
        gradient[l][k] += c.tile[static_cast<std::size_t>(node)] * G[k];
      }
    });
    if (together) {
      sums.scatter(0, lanes, c.record, values.data());
      sums.scatter_slopes(0, lanes, c.columns, slopes.data());
      for (int d = 0; d < 4; ++d) {
        Pack g[3];
        sums.gradient([&](int node) { return splat(c.tile[static_cast<std::size_t>(c.stencil.base[0] + node)][d]); }, g);
        for (int l = 0; l < lanes; ++l) {
          for (int k = 0; k < 3; ++k) ASSERT_NEAR(g[k][l], gradient[l][k][d], round_off);
        }
      }
    } else {
      for (int l = 0; l < lanes; ++l) sums.scatter(l, l + 1, c.record, values.data());
      for (int l = 0; l < lanes; ++l) sums.scatter_slopes(l, l + 1, c.columns, slopes.data());
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_LT(difference(values[i], expected_values[i]), round_off);
      ASSERT_LT(difference(slopes[i], expected_slopes[i]), round_off);
    }
    for (int l = 0; l < lanes; ++l) {
      const auto value = [&](int node) { return c.tile[static_cast<std::size_t>(c.stencil.base[l] + node)]; };
      Pack g[3];
      sums.gradient(l, value, g);
      for (int k = 0; k < 3; ++k) ASSERT_LT(difference(g[k], gradient[l][k]), round_off);
      ASSERT_LT(difference(sums.interpolate(l, value), at[l]), round_off);
    }
  }
}

}  // namespace
}  // namespace crampon::test
