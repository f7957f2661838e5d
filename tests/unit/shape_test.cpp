/// Shape functions as the step sees them, through the stencil: all members of the family, and what every one must have.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "crampon/shape/registry.hpp"
#include "crampon/shape/stencil.hpp"
#include "unit/box_profile.hpp"

namespace crampon::test {
namespace {

double sign(double a) { return a < 0 ? -1 : 1; }

/// The formulas as they are printed (docs/theory/step.md, shape functions).
Profile printed(LinearShape, double xi, double) {
  const double r = std::fabs(xi);
  return r <= 1 ? Profile{1 - r, -sign(xi)} : Profile{};
}
Profile printed(GimpShape, double xi, double l) {
  const double r = std::fabs(xi);
  if (r < l) return {1 - (xi * xi + l * l) / (2 * l), -xi / l};
  if (r < 1 - l) return {1 - r, -sign(xi)};
  if (r < 1 + l) return {(1 + l - r) * (1 + l - r) / (4 * l), -sign(xi) * (1 + l - r) / (2 * l)};
  return {};
}
Profile printed(BsplineShape, double xi, double) {
  const double r = std::fabs(xi);
  if (r < 0.5) return {0.75 - xi * xi, -2 * xi};
  if (r < 1.5) return {0.5 * (1.5 - r) * (1.5 - r), -sign(xi) * (1.5 - r)};
  return {};
}
Profile printed(CubicBsplineShape, double xi, double) {
  const double r = std::fabs(xi);
  if (r < 1) return {2. / 3 - r * r + r * r * r / 2, sign(xi) * (1.5 * r * r - 2 * r)};
  if (r < 2) return {std::pow(2 - r, 3) / 6, -sign(xi) * (2 - r) * (2 - r) / 2};
  return {};
}
Profile printed(CpdiShape, double xi, double l) {
  const Profile low = printed(LinearShape{}, xi - l, 0), high = printed(LinearShape{}, xi + l, 0);
  return {(low.value + high.value) / 2, (high.value - low.value) / (2 * l)};
}

TEST(Boxes, AreThePrintedFormulas) {
  const auto compare = [](auto shape) {
    for (const double l : {0.5, 0.25, 1. / 6, 0.125}) {
      for (double xi = -2.3; xi < 2.3; xi += 0.0173) {
        const Profile a = profile(decltype(shape)::boxes, xi, l), b = printed(shape, xi, l);
        EXPECT_NEAR(a.value, b.value, 1e-13) << shape.name << " at " << xi;
        EXPECT_NEAR(a.slope, b.slope, 1e-12) << shape.name << " at " << xi;
      }
    }
  };
  compare(LinearShape{}), compare(GimpShape{}), compare(BsplineShape{}), compare(CubicBsplineShape{}), compare(CpdiShape{});
}

template <int Dim>
struct Weight {
  double S = 0;
  Vec<Dim> G;  ///< per cell, not per metre: comparable in all directions
};
template <int Dim>
using Weights = std::map<IndexVector<Dim>, Weight<Dim>>;

template <int D, class S>
struct Case {
  static constexpr int dim = D;
  using Shape = S;
};

template <class C>
class ShapeFunctionsOf : public testing::Test {
 protected:
  static constexpr int dim = C::dim;
  using Shape = typename C::Shape;
  using V = Vec<dim>;

  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// Another grid, block and particle size. Cells differ by axis; the origin is off zero.
  void new_place() {
    V origin, cell;
    IndexVector<dim> cells{};
    for (int k = 0; k < dim; ++k) {
      origin[k] = draw(-1, 1);
      cell[k] = draw(0.01, 0.05);
      cells[k] = 44;
      half_size_[k] = 0.5 / std::uniform_int_distribution<int>(1, 4)(random_);
    }
    grid_ = Grid<dim>(origin, cell, cells);
    for (int k = 0; k < dim; ++k)
      first_node_[k] = Grid<dim>::first_node(std::uniform_int_distribution<int>(1, grid_.blocks[k] - 2)(random_));
  }
  /// A place in cells from the block's first node, in the block or in its margin of one cell (the drift between re-orderings).
  V new_local() {
    V g;
    for (int k = 0; k < dim; ++k) g[k] = draw(-0.49, block_side + 0.49);
    return g;
  }
  V position(const V& local) const {
    V x;
    for (int k = 0; k < dim; ++k) x[k] = grid_.origin[k] + (first_node_[k] + local[k]) * grid_.cell[k];
    return x;
  }

  /// Weights by grid node of the first of four particles; the others differ, so that a mixed-up lane shows.
  Weights<dim> weights(const V& x) {
    using T = Tile<dim, Shape>;
    Pack packs[dim];
    for (int k = 0; k < dim; ++k) {
      for (int l = 0; l < lanes; ++l) packs[k][l] = position(new_local())[k];
    }
    const int lane = std::uniform_int_distribution<int>(0, lanes - 1)(random_);
    for (int k = 0; k < dim; ++k) packs[k][lane] = x[k];
    StencilFactors<dim, Shape> factors;
    if constexpr (Shape::has_domains) {
      DomainEdges<dim> edges;  // of particles as they are at the start
      for (int j = 0; j < dim; ++j) {
        for (int k = 0; k < dim; ++k) edges.r[j][k] = splat(j == k ? half_size_[k] : 0.);
      }
      factors.compute(packs, grid_, first_node_, edges);
    } else {
      factors.compute(packs, grid_, first_node_, half_size_);
    }
    const Stencil<dim, Shape> stencil(factors);
    Weights<dim> out;
    for (int n = 0; n < Stencil<dim, Shape>::count; ++n) {
      const int at = factors.base[lane] + T::steps[n];
      EXPECT_GE(at, 0);
      EXPECT_LT(at, T::nodes);
      IndexVector<dim> node = unflatten<dim>(at, T::side);
      for (int k = 0; k < dim; ++k) node[k] += first_node_[k] - T::offset;
      Weight<dim>& w = out[node];
      w.S = stencil.weight(n, lane);
      for (int k = 0; k < dim; ++k) w.G[k] = stencil.slope(n, k, lane) * grid_.cell[k];
    }
    EXPECT_EQ(static_cast<int>(out.size()), T::stencil) << "a node appears twice";
    return out;
  }

  /// Largest difference over all nodes; nodes that only one of the two knows have no weight in the other.
  static std::pair<double, double> apart(const Weights<dim>& a, const Weights<dim>& b) {
    double S = 0, G = 0;
    const auto compare = [&](const Weights<dim>& from, const Weights<dim>& with) {
      for (const auto& [node, w] : from) {
        const auto at = with.find(node);
        const Weight<dim> other = at == with.end() ? Weight<dim>{} : at->second;
        S = std::fmax(S, std::fabs(w.S - other.S));
        G = std::fmax(G, norm(w.G - other.G));
      }
    };
    compare(a, b);
    compare(b, a);
    return {S, G};
  }

  std::mt19937_64 random_{20030117};
  Grid<dim> grid_;
  IndexVector<dim> first_node_{};
  HalfSize<dim> half_size_{};
};

/// Every member of the family, in the plane and in space.
template <class... Shapes>
testing::Types<Case<2, Shapes>..., Case<3, Shapes>...> cases_of(ShapeList<Shapes...>);
using Cases = decltype(cases_of(ShapeFunctions{}));
struct Names {
  template <class C>
  static std::string GetName(int) {
    return std::string(C::Shape::name) + (C::dim == 2 ? "_2d" : "_3d");
  }
};
TYPED_TEST_SUITE(ShapeFunctionsOf, Cases, Names);

constexpr int places = 300, positions = 10;
// In cells, where particles are up to 50 cells from the origin: a position is known to 50 * 1e-16, and sums have up to 27 terms.
constexpr double round_off = 1e-13;

TYPED_TEST(ShapeFunctionsOf, SumToOneAndReproduceLinearFields) {
  constexpr int Dim = TypeParam::dim;
  for (int place = 0; place < places; ++place) {
    this->new_place();
    for (int q = 0; q < positions; ++q) {
      const Vec<Dim> x = this->position(this->new_local());
      double sum = 0;
      Vec<Dim> gradient_sum, mean;
      double moment[Dim][Dim] = {};  // sum x_i (x) G_i in cells
      for (const auto& [node, w] : this->weights(x)) {
        EXPECT_GE(w.S, 0);
        sum += w.S;
        gradient_sum += w.G;
        for (int k = 0; k < Dim; ++k) {
          const double from_particle = (this->grid_.node_coordinate(k, node[k]) - x[k]) / this->grid_.cell[k];
          mean[k] += from_particle * w.S;
          for (int d = 0; d < Dim; ++d) moment[k][d] += from_particle * w.G[d];
        }
      }
      ASSERT_NEAR(sum, 1, round_off);
      for (int k = 0; k < Dim; ++k) {
        ASSERT_NEAR(gradient_sum[k], 0, round_off);
        ASSERT_NEAR(mean[k], 0, round_off);
        for (int d = 0; d < Dim; ++d) ASSERT_NEAR(moment[k][d], k == d ? 1 : 0, round_off);
      }
    }
  }
}

TYPED_TEST(ShapeFunctionsOf, AreTheirBoxesAndNothingElse) {
  constexpr int Dim = TypeParam::dim;
  for (int place = 0; place < places; ++place) {
    this->new_place();
    for (int q = 0; q < positions; ++q) {
      const Vec<Dim> x = this->position(this->new_local());
      Weights<Dim> expected;
      // All nodes around, also those beyond the stencil: what is left out must be zero.
      IndexVector<Dim> nearest{};
      for (int k = 0; k < Dim; ++k) nearest[k] = static_cast<int>(std::lround((x[k] - this->grid_.origin[k]) / this->grid_.cell[k]));
      for (int n = 0; n < power(5, Dim); ++n) {
        IndexVector<Dim> node = unflatten<Dim>(n, 5);
        Profile f[Dim];
        for (int k = 0; k < Dim; ++k) {
          node[k] += nearest[k] - 2;
          f[k] =
              profile(TypeParam::Shape::boxes, (x[k] - this->grid_.node_coordinate(k, node[k])) / this->grid_.cell[k], this->half_size_[k]);
        }
        Weight<Dim>& w = expected[node];
        w.S = 1;
        for (int k = 0; k < Dim; ++k) w.S *= f[k].value;
        for (int d = 0; d < Dim; ++d) {
          w.G[d] = f[d].slope;
          for (int k = 0; k < Dim; ++k) {
            if (k != d) w.G[d] *= f[k].value;
          }
        }
      }
      const auto [S, G] = this->apart(this->weights(x), expected);
      ASSERT_LT(S, round_off);
      // A slope changes by up to 1/l = 8 (quarter cells) per cell.
      ASSERT_LT(G, 10 * round_off);
    }
  }
}

/// Positions at which a profile changes its branch or the stencil moves on: node lines, mid-cell lines, l and 1 - l beside a node.
TYPED_TEST(ShapeFunctionsOf, AreContinuousAcrossCellBordersAndBranches) {
  constexpr int Dim = TypeParam::dim;
  constexpr double step = 1e-9;
  for (int place = 0; place < places; ++place) {
    this->new_place();
    for (int axis = 0; axis < Dim; ++axis) {
      const double l = this->half_size_[axis];
      for (const double border : {0., 0.5, l, 1 - l}) {
        Vec<Dim> low = this->new_local();
        low[axis] = std::uniform_int_distribution<int>(0, block_side - 1)(this->random_) + border - step;
        Vec<Dim> high = low;
        high[axis] += 2 * step;
        const auto [S, G] = this->apart(this->weights(this->position(low)), this->weights(this->position(high)));
        // Slopes are at most one per cell, their change at most 1/l = 8 per cell.
        ASSERT_LT(S, 2.1 * step) << "axis " << axis << " at " << border;
        constexpr bool smooth = TypeParam::Shape::boxes.smoothness() > 0;
        ASSERT_TRUE(!smooth || G < 8.1 * 2 * step * Dim) << G << "axis " << axis << " at " << border;
      }
    }
  }
}

TYPED_TEST(ShapeFunctionsOf, HaveTheGradientsOfTheirValues) {
  constexpr int Dim = TypeParam::dim;
  if constexpr (TypeParam::Shape::boxes.ends > 0) {
    GTEST_SKIP() << "slopes of domains are not those of their values, but of what is linear between the ends: AreTheirBoxesAndNothingElse";
  }
  constexpr double step = 1e-5;
  for (int place = 0; place < places; ++place) {
    this->new_place();
    Vec<Dim> local = this->new_local();
    for (int k = 0; k < Dim; ++k) {
      if (std::fabs(local[k] - std::round(local[k])) < 2 * step) local[k] += 0.1;  // the kink of the linear function
    }
    const Weights<Dim> here = this->weights(this->position(local));
    for (int axis = 0; axis < Dim; ++axis) {
      Vec<Dim> low = local, high = local;
      low[axis] -= step;
      high[axis] += step;
      Weights<Dim> a = this->weights(this->position(low)), b = this->weights(this->position(high));
      for (const auto& [node, w] : here) {
        // Exact but for the jump of the second derivative, at most 1/l = 8, within a step, and 1e-14/step of round-off.
        ASSERT_NEAR((b[node].S - a[node].S) / (2 * step), w.G[axis], 8 * step + 1e-8);
      }
    }
  }
}

/// Derivatives across the borders of the test above: as many are continuous as the boxes say, and no more.
TYPED_TEST(ShapeFunctionsOf, AreAsSmoothAsTheirBoxes) {
  // The tests look at slopes. Those of domains are differences of the values at the ends, and jump no more.
  constexpr int Dim = TypeParam::dim, smoothness = TypeParam::Shape::boxes.smoothness() + TypeParam::Shape::boxes.ends;
  constexpr double step = 1e-3;
  double jump[4] = {};  // largest, of the derivative of this order; per cell
  for (int place = 0; place < places / 10; ++place) {
    this->new_place();
    for (int axis = 0; axis < Dim; ++axis) {
      const double l = this->half_size_[axis];
      for (const double border : {0., 0.5, l, 1 - l}) {
        Vec<Dim> local;
        for (int k = 0; k < Dim; ++k) local[k] = 3;  // at a node, whose functions along the other axes are not small
        // Slopes beside the border; of polynomials, which derivatives on one side follow from.
        std::map<IndexVector<Dim>, std::array<double, 4>> derivatives[2];
        for (const int side : {0, 1}) {
          Weights<Dim> at[4];
          for (int k = 1; k < 4; ++k) {
            local[axis] = 3 + border + (side == 0 ? -k : k) * step;
            at[k] = this->weights(this->position(local));
          }
          for (const auto& [node, w] : at[1]) {
            const auto slope = [&](int k) { return at[k].contains(node) ? at[k].at(node).G[axis] : 0.; };
            const double out = side == 0 ? -1 : 1;
            derivatives[side][node] = {0, 3 * slope(1) - 3 * slope(2) + slope(3),
                                       out * (-2.5 * slope(1) + 4 * slope(2) - 1.5 * slope(3)) / step,
                                       (slope(1) - 2 * slope(2) + slope(3)) / (step * step)};
          }
        }
        for (const int side : {0, 1}) {
          for (const auto& [node, d] : derivatives[side]) {
            for (std::size_t k = 1; k < 4; ++k) {
              const double other = derivatives[1 - side].contains(node) ? derivatives[1 - side].at(node)[k] : 0.;
              jump[k] = std::fmax(jump[k], std::fabs(d[k] - other));
            }
          }
        }
      }
    }
  }
  // Exact for pieces of up to the third degree, but for round-off of slopes over step^2.
  for (int k = 1; k <= smoothness; ++k) EXPECT_LT(jump[k], 1e-5) << "derivative " << k;
  static_assert(smoothness < 3, "the third derivative is the last that four slopes tell");
  EXPECT_GT(jump[smoothness + 1], 0.3) << "derivative " << smoothness + 1 << " is continuous, too";
}

/// No node beyond the reach has a weight, and those just within it have one.
TYPED_TEST(ShapeFunctionsOf, EndAtTheirReach) {
  using Of = typename TypeParam::Shape;
  constexpr int Dim = TypeParam::dim;
  double furthest_over_reach = 0;
  for (int place = 0; place < places; ++place) {
    this->new_place();
    for (int q = 0; q < positions; ++q) {
      Vec<Dim> local = this->new_local();
      // A hair within reach of a node along an axis.
      const int axis = q % Dim;
      const double reach = Of::boxes.reach(this->half_size_[axis]);
      EXPECT_LE(reach, Of::reach(this->half_size_[axis]));
      if (q % 2 == 0) local[axis] = 4 + (q % 4 == 0 ? 1 : -1) * (reach - 0.01);
      const Vec<Dim> x = this->position(local);
      for (const auto& [node, w] : this->weights(x)) {
        for (int k = 0; k < Dim; ++k) {
          const double away = std::fabs(this->grid_.node_coordinate(k, node[k]) - x[k]) / this->grid_.cell[k];
          if (away > Of::boxes.reach(this->half_size_[k]) + 1e-12) {
            EXPECT_EQ(w.S, 0) << away << " cells away";
          }
          if (w.S > 0) furthest_over_reach = std::fmax(furthest_over_reach, away / Of::boxes.reach(this->half_size_[k]));
        }
      }
    }
  }
  EXPECT_GT(furthest_over_reach, 0.99);
  EXPECT_LE(furthest_over_reach, 1 + 1e-12);
}

/// On a grid line no node may have a gradient without a weight, or a force would fall on a node without mass (conventions 38).
TYPED_TEST(ShapeFunctionsOf, OnGridLinesLeaveNoForceWithoutMass) {
  constexpr int Dim = TypeParam::dim;
  for (int place = 0; place < places; ++place) {
    this->new_place();
    // A binary grid, so that positions lie on the lines to the last bit.
    Vec<Dim> cell, origin;
    for (int k = 0; k < Dim; ++k) cell[k] = 1. / 32, origin[k] = -0.5;
    this->grid_ = Grid<Dim>(origin, cell, this->grid_.cells);
    Vec<Dim> local = this->new_local();
    for (int k = 0; k < Dim; ++k) {
      if (k == place % Dim || place % 3 == 0) local[k] = std::uniform_int_distribution<int>(0, block_side)(this->random_);
    }
    const Weights<Dim> weights = this->weights(this->position(local));
    double sum = 0;
    Vec<Dim> gradient_sum;
    for (const auto& [node, w] : weights) {
      EXPECT_TRUE(w.S > 0 || norm(w.G) == 0);
      sum += w.S;
      gradient_sum += w.G;
      // Bounded: a force on the node stays of the order of its mass's share, w.S >= (1e-12)^Dim where the linear function is taken aside.
      for (int k = 0; k < Dim; ++k) EXPECT_LE(std::fabs(w.G[k]), 1 + round_off);
    }
    EXPECT_NEAR(sum, 1, round_off);
    for (int k = 0; k < Dim; ++k) EXPECT_NEAR(gradient_sum[k], 0, round_off);
    // Values are those on the line to the 1e-12 of a cell by which the linear function is taken aside, once per axis.
    for (const auto& [node, w] : weights) {
      double expected = 1;
      for (int k = 0; k < Dim; ++k)
        expected *= profile(TypeParam::Shape::boxes, this->first_node_[k] + local[k] - node[k], this->half_size_[k]).value;
      EXPECT_NEAR(w.S, expected, Dim * 1.1e-12);
    }
  }
}

}  // namespace
}  // namespace crampon::test
