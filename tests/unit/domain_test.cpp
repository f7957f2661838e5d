/// Shape functions of domains that stretch, shear and turn (shape/domain.hpp), as the step sees them, and the edges that nodes read from them.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "crampon/contact/edge_map.hpp"
#include "crampon/shape/cpdi.hpp"
#include "crampon/shape/stencil.hpp"

namespace crampon::test {
namespace {

template <int Dim>
class Domains {
 public:
  using Edges = std::array<std::array<double, Dim>, Dim>;  ///< [axis][edge], cells

  Domains() {
    Vec<Dim> origin, cell;
    IndexVector<Dim> cells{};
    for (int k = 0; k < Dim; ++k) origin[k] = draw(-1, 1), cell[k] = draw(0.01, 0.05), cells[k] = 20;
    grid_ = Grid<Dim>(origin, cell, cells);
  }
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec<Dim> new_place() {
    Vec<Dim> g;
    for (int k = 0; k < Dim; ++k) g[k] = draw(1, block_side - 1);
    return g;
  }

  /// f(node less particle in cells, S, G in cells) for the nodes of a particle at `place` with these half edges; `other` is that of the lanes beside it.
  template <class F>
  void for_nodes(const Vec<Dim>& place, const Edges& edges, const Edges& other, F f) {
    using T = Tile<Dim, CpdiShape>;
    constexpr int lane = 2;
    Pack x[Dim];
    DomainEdges<Dim> packs;
    for (int k = 0; k < Dim; ++k) {
      for (int l = 0; l < lanes; ++l) x[k][l] = grid_.origin[k] + (l == lane ? place[k] : draw(1, block_side - 1)) * grid_.cell[k];
      for (int j = 0; j < Dim; ++j) {
        packs.r[k][j] = splat(other[k][j]);
        packs.r[k][j][lane] = edges[k][j];
      }
    }
    StencilFactors<Dim, CpdiShape> factors;
    factors.compute(x, grid_, {}, packs);
    const Stencil<Dim, CpdiShape> stencil(factors);
    for (int n = 0; n < Stencil<Dim, CpdiShape>::count; ++n) {
      const IndexVector<Dim> node = unflatten<Dim>(factors.base[lane] + T::steps[n], T::side);
      Vec<Dim> away, G;
      for (int k = 0; k < Dim; ++k) {
        away[k] = node[k] - T::offset - place[k];
        G[k] = stencil.slope(n, k, lane) * grid_.cell[k];
        EXPECT_NEAR(factors.slope(n, k, lane) * grid_.cell[k], G[k], 1e-14) << "as sums over a lane see it";
      }
      EXPECT_NEAR(factors.weight(n, lane), stencil.weight(n, lane), 1e-15);
      f(away, stencil.weight(n, lane), G);
    }
  }

 private:
  std::mt19937_64 random_{20111435};
  Grid<Dim> grid_;
};

double hat(double xi) { return std::fmax(0., 1 - std::fabs(xi)); }

template <int Dim>
typename Domains<Dim>::Edges box(double half_size) {
  typename Domains<Dim>::Edges edges{};
  for (std::size_t k = 0; k < Dim; ++k) edges[k][k] = half_size;
  return edges;
}

template <int Dim>
void expect_linear_completeness() {
  Domains<Dim> domains;
  for (int trial = 0; trial < 500; ++trial) {
    typename Domains<Dim>::Edges edges = box<Dim>(0);
    for (auto& row : edges) {
      for (double& r : row) r = domains.draw(-0.1, 0.1);
    }
    for (std::size_t k = 0; k < edges.size(); ++k) edges[k][k] = domains.draw(0.25, 0.6);
    double sum = 0, moment[Dim][Dim] = {};
    Vec<Dim> mean, slopes;
    domains.for_nodes(domains.new_place(), edges, box<Dim>(0.25), [&](const Vec<Dim>& away, double S, const Vec<Dim>& G) {
      EXPECT_GE(S, -1e-15);
      if (S < 1e-14) {
        EXPECT_LT(norm(G), 1e-12) << "a force on a node without mass";
      }
      sum += S;
      mean += away * S;
      slopes += G;
      for (int k = 0; k < Dim; ++k) {
        for (int d = 0; d < Dim; ++d) moment[k][d] += away[k] * G[d];
      }
    });
    ASSERT_NEAR(sum, 1, 1e-13);
    for (int k = 0; k < Dim; ++k) {
      ASSERT_NEAR(mean[k], 0, 1e-13);
      ASSERT_NEAR(slopes[k], 0, 1e-12);
      for (int d = 0; d < Dim; ++d) ASSERT_NEAR(moment[k][d], k == d ? 1 : 0, 1e-12);
    }
  }
}
TEST(Domains, ReproduceLinearFieldsInThePlane) { expect_linear_completeness<2>(); }
TEST(Domains, ReproduceLinearFieldsInSpace) { expect_linear_completeness<3>(); }

/// S: the mean of the linear functions over the corners; G against the gradient of a field that is linear in the domain.
TEST(Domains, AreMeansOverCorners) {
  Domains<2> domains;
  for (int trial = 0; trial < 500; ++trial) {
    const Domains<2>::Edges e = {{{domains.draw(0.1, 0.3), domains.draw(-0.2, 0.2)}, {domains.draw(-0.2, 0.2), domains.draw(0.1, 0.3)}}};
    domains.for_nodes(domains.new_place(), e, box<2>(0.25), [&](const Vec<2>& away, double S, const Vec<2>& G) {
      double mean = 0, along[2] = {0, 0};  // half the difference over an edge
      for (const double s : {-1., 1.}) {
        for (const double t : {-1., 1.}) {
          const double N = hat(s * e[0][0] + t * e[0][1] - away[0]) * hat(s * e[1][0] + t * e[1][1] - away[1]);
          mean += N / 4;
          along[0] += s * N / 4;
          along[1] += t * N / 4;
        }
      }
      ASSERT_NEAR(S, mean, 1e-13);
      for (std::size_t j = 0; j < 2; ++j) ASSERT_NEAR(G[0] * e[0][j] + G[1] * e[1][j], along[j], 1e-13);
    });
  }
}

/// A corner on a line of nodes, but for round-off: no node beyond it gets a mass that is none, which a force would move beyond all bounds.
TEST(Domains, GiveNoNodeNextToNothing) {
  Domains<2> plane;
  Domains<3> space;
  const auto expect_enough = [](const auto&, double S, const auto&) { EXPECT_TRUE(S == 0 || S > 1e-26) << S; };
  for (const double off : {0., 1e-300, 1e-18, -1e-18, 1e-14, 1e-11}) {
    auto edges = box<2>(0.25);
    edges[0][1] = off;
    plane.for_nodes({{3.25, 4.75}}, edges, box<2>(0.25), expect_enough);
    space.for_nodes({{3.25, 4.75, 3.25 + off}}, box<3>(0.25), box<3>(0.25), expect_enough);
  }
}

/// Longer than a cell: as long as a cell, so that three nodes along each axis are enough.
TEST(Domains, ReachNoFurtherThanTheirStencil) {
  Domains<2> domains;
  const Vec<2> place = domains.new_place();
  std::vector<double> long_ones, limit;
  domains.for_nodes(place, box<2>(0.8), box<2>(0.25), [&](const Vec<2>&, double S, const Vec<2>&) { long_ones.push_back(S); });
  domains.for_nodes(place, box<2>(0.5), box<2>(0.25), [&](const Vec<2>&, double S, const Vec<2>&) { limit.push_back(S); });
  for (std::size_t n = 0; n < limit.size(); ++n) EXPECT_NEAR(long_ones[n], limit[n], 1e-14);
}

/// A node beside layers of such particles finds their edge from their mean position, wherever it is.
TEST(Domains, ShowNodesTheirEdge) {
  for (const double l : {0.5, 0.25, 0.125}) {
    const double half_sizes[] = {l};
    const EdgeMap map = EdgeMap(CpdiShape::boxes, half_sizes);
    double before = map.edge_distance(-1);
    for (double d = -0.99; d < 1 - l; d += 0.02) {
      double sum = 0, mean = 0;
      for (double x = d + l; x < 3; x += 2 * l) {
        const double S = 0.5 * (hat(x - l) + hat(x + l));
        sum += S;
        mean += S * x;
      }
      if (sum < 1e-3) continue;
      EXPECT_NEAR(map.edge_distance(mean / sum), d, 2e-3) << l << " at " << d;
    }
    for (double p = -1; p < 3; p += 1e-3) {
      const double d = map.edge_distance(p);
      ASSERT_GE(d, before);
      before = d;
    }
  }
}

}  // namespace
}  // namespace crampon::test
