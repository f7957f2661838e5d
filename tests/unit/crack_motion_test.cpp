// How points of cracks move, in the plane and in space: normals of vertices, carriers, planes between their surfaces, forces of tractions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

#include "cracked_solid.hpp"
#include "crampon/crack/traction/linear_elastic.hpp"
#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/crack_motion.hpp"
#include "crampon/step/crack_tractions.hpp"
#include "crampon/step/linear_fit.hpp"
#include "crampon/step/point_fields.hpp"
#include "crampon/step/verbs.hpp"
#include "crampon/step/view_cracks.hpp"

namespace crampon {
namespace {

using namespace crampon::testing;

using Rng = std::mt19937_64;
double draw(Rng& rng, double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }
template <int Dim>
Vec<Dim> random_vector(Rng& rng, double size) {
  Vec<Dim> x;
  for (int k = 0; k < Dim; ++k) x[k] = draw(rng, -size, size);
  return x;
}

template <class Dimension>
class CrackMotion : public ::testing::Test {
 public:
  static constexpr int dimension = Dimension::value;
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CrackMotion, Dimensions);

TEST(VertexNormals, CountTrianglesByTheirAreas) {
  // The area vectors of a closed surface add up to nothing: at a vertex of a tetrahedron three of them are the fourth, reversed.
  Rng rng(1);
  for (int k = 0; k < 200; ++k) {
    Crack<3> crack;
    for (int v = 0; v < 4; ++v) crack.plane.push_back(random_vector<3>(rng, 1));
    crack.facets = {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}};
    const std::vector<Vec<3>> normals = vertex_normals(crack);
    for (VertexId v = 0; v < 4; ++v) EXPECT_LT(norm(normals[v] + facet_normal<3>(crack.plane, crack.facets[v])), 1e-9);  // flat ones cancel
  }
}

TEST(VertexNormals, HalveTheCornersOfPaths) {
  Rng rng(2);
  for (int k = 0; k < 200; ++k) {
    Crack<2> crack;
    for (int v = 0; v < 5; ++v) crack.plane.push_back(random_vector<2>(rng, 1));
    crack.closed = k % 2 == 1;
    if (crack.closed) crack.plane.back() = crack.plane.front();
    for (VertexId v = 0; v < 4; ++v) crack.facets.push_back({v, v + 1});
    const std::vector<Vec<2>> normals = vertex_normals(crack);
    for (std::size_t v = crack.closed ? 0 : 1; v < (crack.closed ? 5u : 4u); ++v) {
      const Vec<2> before = normalized(crack.plane[v] - crack.plane[v == 0 ? 3 : v - 1]);
      const Vec<2> after = normalized(crack.plane[v == 4 ? 1 : v + 1] - crack.plane[v]);
      // As far to the right of the way there as of the way on.
      EXPECT_NEAR(cross(before, normals[v]), cross(after, normals[v]), 1e-9);
      EXPECT_LT(cross(before, normals[v]), 0);
    }
  }
}

TYPED_TEST(CrackMotion, FitsReproduceLinearFields) {
  constexpr int Dim = TestFixture::dimension;
  Rng rng(3);
  for (int k = 0; k < 300; ++k) {
    // Around the point or to one side of it, in boxes of any shape that are not flat.
    std::vector<Vec<Dim>> places;
    std::vector<double> weights;
    const Vec<Dim> middle = random_vector<Dim>(rng, k % 2);
    Vec<Dim> size;
    for (int d = 0; d < Dim; ++d) size[d] = draw(rng, 0.5, 2);
    for (int i = 0; i < 40; ++i) {
      Vec<Dim> y = middle;
      for (int d = 0; d < Dim; ++d) y[d] += size[d] * draw(rng, -1, 1);
      places.push_back(y);
      weights.push_back(draw(rng, 0.1, 1));
    }
    const LinearFit<Dim> fit(places, weights);
    ASSERT_GT(fit.variance, LinearFit<Dim>::least_variance);
    const auto field = Affine<Dim>::random(rng, {}, 1, 1);
    double sum = 0;
    Vec<Dim> at_point;
    for (std::size_t i = 0; i < places.size(); ++i) sum += weights[i], at_point += field(places[i]) * weights[i];
    EXPECT_NEAR(sum, 1, 1e-13);
    EXPECT_LT(norm(at_point - field.b), 1e-12) << "the field at the point itself";
  }
}

TYPED_TEST(CrackMotion, FitsDoNotGuessAcrossFlatSetsOfParticles) {
  constexpr int Dim = TestFixture::dimension;
  Rng rng(4);
  for (int k = 0; k < 100; ++k) {
    const Vec<Dim> across = normalized(random_vector<Dim>(rng, 1));
    std::vector<Vec<Dim>> places;
    std::vector<double> weights;
    for (int i = 0; i < 40; ++i) {
      const Vec<Dim> y = random_vector<Dim>(rng, 1);
      places.push_back(y - across * (dot(y, across) - 0.5));  // all at the height 0.5
      weights.push_back(draw(rng, 0.1, 1));
    }
    const LinearFit<Dim> fit(places, weights);
    EXPECT_FALSE(fit.good());
    EXPECT_NEAR(fit.variance, 0, 1e-14);
    double sum = 0;
    Vec<Dim> place;
    for (std::size_t i = 0; i < places.size(); ++i) sum += weights[i], place += places[i] * weights[i];
    EXPECT_NEAR(sum, 1, 1e-13);
    EXPECT_LT(norm(place - across * 0.5), 1e-12) << "right along the set, and the middle across";
  }
}

TYPED_TEST(CrackMotion, CracksGoWithAnAffineMotion) {
  constexpr int Dim = TestFixture::dimension;
  CrackedSolid<Dim> s;
  s.choose_carriers();
  Crack<Dim>& crack = s.crack();
  const auto u = Affine<Dim>::random(s.rng, s.centre, 0.05, 0.1);
  s.work.now.dt = 0.25;
  s.displace(u);
  s.set_nodes([&](const Vec<Dim>& x) { return u(x) * 4; });
  move_cracks(s.state, s.work, s.model);
  // Sums of some dozens of numbers of the size of one.
  const auto expect_all_at = [&](const Crack<Dim>& c, auto displaced) {
    for (std::size_t v = 0; v < c.plane.size(); ++v) {
      const Vec<Dim> x = c.original[v] + displaced(c.original[v]);
      EXPECT_LT(norm(c.upper[v] - x), 1e-12);
      EXPECT_LT(norm(c.lower[v] - x), 1e-12);
      EXPECT_LT(norm(c.plane[v] - x), 1e-12);
    }
  };
  expect_all_at(crack, u);
  for (const CrackOpening& o : openings_of(crack)) {
    EXPECT_NEAR(o.opening, 0, 1e-12);
    EXPECT_NEAR(o.sliding, 0, 1e-12);
  }
  // Particles are put elsewhere: what they carry follows.
  const auto w = Affine<Dim>::random(s.rng, s.centre, 0.05, 0.1);
  s.displace(w);
  carry_cracks(s.state, s.work);
  expect_all_at(crack, w);
  // Positions lead the present by what particles move in the time between.
  const auto rate = Affine<Dim>::random(s.rng, s.centre, 1, 1);
  s.state.particles.lead = 0.01;
  for (std::size_t p = 0; p < s.state.particles.size(); ++p) {
    s.state.particles.set_motion(p, s.state.particles.position(p), rate(s.state.particles.original[p]));
  }
  expect_all_at(present_crack(s.state, s.work, crack), [&](const Vec<Dim>& X) { return w(X) - rate(X) * 0.01; });
  expect_all_at(crack, w);
}

TYPED_TEST(CrackMotion, FixedPlanesStay) {
  constexpr int Dim = TestFixture::dimension;
  CrackedSolid<Dim> s;
  s.choose_carriers();
  s.crack().fixed = true;
  s.work.now.dt = 1;
  const Vec<Dim> shift = random_vector<Dim>(s.rng, 0.1);
  s.displace([&](const Vec<Dim>&) { return shift; });
  s.set_nodes([&](const Vec<Dim>&) { return shift; });
  move_cracks(s.state, s.work, s.model);
  EXPECT_EQ(s.crack().plane, s.crack().original);
  EXPECT_LT(norm(s.crack().upper.front() - s.crack().original.front() - shift), 1e-12);
}

TYPED_TEST(CrackMotion, SurfacesPartAndThePlaneStaysBetween) {
  constexpr int Dim = TestFixture::dimension;
  for (const double drift : {0., 0.3, -0.3}) {
    CrackedSolid<Dim> s;
    s.choose_carriers();
    const Vec<Dim> of_upper = s.up * 0.06 + s.along * 0.04, of_lower = s.up * -0.02 + s.along * 0.07;
    s.displace([&](const Vec<Dim>& X) { return s.is_above(X) ? of_upper : of_lower; });
    // Without mass on nodes the plane goes with its surfaces, else with the nodes: here so far that it leaves the gap.
    s.work.now.dt = 1;
    const Vec<Dim> of_nodes = s.up * drift + s.along * 0.01;
    if (drift == 0) s.leave_nodes_empty();
    if (drift != 0) s.set_nodes([&](const Vec<Dim>&) { return of_nodes; });
    move_cracks(s.state, s.work, s.model);
    const Vec<Dim> of_plane = drift == 0 ? (of_upper + of_lower) * 0.5 : s.up * 0.02 + s.along * 0.01;
    const std::vector<CrackOpening> openings = openings_of(s.crack());
    for (std::size_t v = 0; v < openings.size(); ++v) {
      EXPECT_LT(norm(s.crack().upper[v] - s.crack().original[v] - of_upper), 1e-12);
      EXPECT_LT(norm(s.crack().lower[v] - s.crack().original[v] - of_lower), 1e-12);
      EXPECT_LT(norm(s.crack().plane[v] - s.crack().original[v] - of_plane), 1e-12);
      EXPECT_NEAR(openings[v].opening, 0.08, 1e-12);
      EXPECT_NEAR(openings[v].sliding, Dim == 2 ? -0.03 : 0.03, 1e-12) << "the upper side goes back along the path";
    }
  }
}

TYPED_TEST(CrackMotion, VerticesThatNothingMovesGoWithTheNearest) {
  constexpr int Dim = TestFixture::dimension;
  CrackedSolid<Dim> s(5);
  Crack<Dim>& crack = s.crack();
  const std::size_t n = crack.plane.size(), first = 1, second = n - 1;
  // Only these two have carriers, which move in different ways.
  crack.upper_carriers.resize(n), crack.lower_carriers.resize(n);
  for (const std::size_t v : {first, second}) {
    crack.upper_carriers[v] = s.carriers(crack.plane[v], true);
    crack.lower_carriers[v] = s.carriers(crack.plane[v], false);
  }
  s.leave_nodes_empty();
  const auto u = Affine<Dim>::random(s.rng, s.centre, 0.1, 0.1);
  s.displace(u);
  move_cracks(s.state, s.work, s.model);
  // How many facets lead from one vertex to another, by trying again and again.
  const auto distances = [&](std::size_t from) {
    std::vector<std::size_t> d(n, n);
    d[from] = 0;
    for (std::size_t round = 0; round < n; ++round) {
      for (const Facet<Dim>& f : crack.facets) {
        for (const VertexId a : f) {
          for (const VertexId b : f) d[a] = std::min(d[a], d[b] + 1);
        }
      }
    }
    return d;
  };
  const std::vector<std::size_t> to_first = distances(first), to_second = distances(second);
  int told = 0;
  for (std::size_t v = 0; v < n; ++v) {
    if (to_first[v] == to_second[v]) continue;
    const Vec<Dim> moved = u(crack.original[to_first[v] < to_second[v] ? first : second]);
    EXPECT_LT(norm(crack.plane[v] - crack.original[v] - moved), 1e-12) << "vertex " << v;
    EXPECT_LT(norm(crack.upper[v] - crack.plane[v]), 1e-12);
    EXPECT_LT(norm(crack.lower[v] - crack.plane[v]), 1e-12);
    ++told;
  }
  EXPECT_GE(told, 5);
}

template <class Shape, int Dim>
void expect_nodes_reproduce_points(const CrackedSolid<Dim>& s) {
  std::vector<NodeOfPoint> nodes;
  for (std::size_t v = 0; v < s.state.cracks.list[0].plane.size(); ++v) {
    for (const Carriers* side : {&s.state.cracks.list[0].upper_carriers, &s.state.cracks.list[0].lower_carriers}) {
      find_nodes_of_point<Dim, Shape>(s.state, s.work, s.model, (*side)[v], nodes);
      double sum = 0;
      Vec<Dim> place;
      std::set<std::size_t> slots;
      for (const NodeOfPoint& n : nodes) {
        sum += n.weight;
        place += s.node_position(n.block, n.slot) * n.weight;
        ASSERT_TRUE(slots.insert(n.slot).second) << "none twice";
        ASSERT_EQ(n.flip, 0);
      }
      ASSERT_NEAR(sum, 1, 1e-12);
      ASSERT_LT(norm(place - s.state.cracks.list[0].plane[v]), 1e-11) << Shape::name;
    }
  }
}

TYPED_TEST(CrackMotion, NodesOfAPointGiveItALinearFieldThroughItsCarriers) {
  CrackedSolid<TestFixture::dimension> s;
  s.choose_carriers();
  expect_nodes_reproduce_points<LinearShape>(s);
  expect_nodes_reproduce_points<BsplineShape>(s);
}

TYPED_TEST(CrackMotion, PointsSeeFunctionsThatAddUpToOne) {
  constexpr int Dim = TestFixture::dimension;
  CrackedSolid<Dim> s;
  for (const bool same : {false, true}) {
    s.model.shape_functions = kind_of<CubicBsplineShape>;
    s.model.crack_shape_functions = same ? CrackShapeFunctions::same : CrackShapeFunctions::linear;
    const PointFields<Dim> fields(s.work, s.model);
    for (int k = 0; k < 200; ++k) {
      const Vec<Dim> x = s.centre + random_vector<Dim>(s.rng, 1);
      double sum = 0;
      Vec<Dim> place, slopes;
      std::array<Vec<Dim>, Dim> gradient{};
      const PointNodes<Dim> nodes = fields.nodes(x);
      for (const PointNode<Dim>& n : nodes) {
        sum += n.S, place += n.x * n.S, slopes += n.G;
        for (int d = 0; d < Dim; ++d) gradient[d] += n.G * n.x[d];
        EXPECT_EQ(n.x, s.model.grid.node_position(s.work.blocks.list[n.block].node(n.local)));
      }
      EXPECT_NEAR(sum, 1, 1e-13);
      EXPECT_LT(norm(place - x), 1e-12);
      EXPECT_LT(norm(slopes), 1e-11);
      for (int d = 0; d < Dim; ++d) {
        Vec<Dim> unit;
        unit[d] = 1;
        EXPECT_LT(norm(gradient[d] - unit), 1e-11);
      }
      EXPECT_EQ(nodes.size(), static_cast<std::size_t>(power(same ? 4 : 2, Dim)));
    }
  }
}

TYPED_TEST(CrackMotion, TractionsPullAgainstTheGapAndGiveNodesNoForceInAll) {
  constexpr int Dim = TestFixture::dimension;
  CrackedSolid<Dim> s;
  s.choose_carriers();
  Crack<Dim>& crack = s.crack();
  const std::size_t n = crack.plane.size();
  CrackTraction& traction = s.model.tractions.front();
  traction.law = LinearElasticTraction{2e6, 2e6};  // as stiff in sliding as in opening: a spring along the gap
  for (std::size_t v = 0; v < n; ++v) crack.traction.area.push_back(v % 4 == 3 ? 0 : s.draw(0.1, 0.3));
  s.set_nodes([](const Vec<Dim>&) { return Vec<Dim>{}; });
  start_tractions(s.state, s.model);
  const StiffestVertex none = spread_tractions<Dim, LinearShape>(s.state, s.work, s.model);
  EXPECT_GT(none.time_step, 0);
  EXPECT_LT(none.time_step, std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < n; ++v) crack.upper[v] += s.up * s.draw(0.01, 0.03) + random_vector<Dim>(s.rng, 0.009);
  update_tractions(s.state, s.work, s.model);
  double stored = 0;
  for (std::size_t v = 0; v < n; ++v) {
    const Vec<Dim> gap = crack.upper[v] - crack.lower[v];
    const double stiffness = 2e6 * crack.traction.area[v];
    EXPECT_LT(norm(crack.traction.force[v] + gap * stiffness), 1e-9 * 2e6);
    stored += 0.5 * stiffness * dot(gap, gap);
  }
  EXPECT_NEAR(s.state.ledger.cohesive.stored, stored, 1e-12 * stored);

  // Both sides of a vertex are at one place now, and so are the forces on them: they make no couple either.
  spread_tractions<Dim, LinearShape>(s.state, s.work, s.model);
  std::fill(s.work.nodes.force.nodes.begin(), s.work.nodes.force.nodes.end(), NodalVector<Dim>{});
  for (std::size_t b = 0; b < s.work.blocks.size(); ++b) add_tractions(s.work, b);
  Vec<Dim> force;
  std::array<Vec<Dim>, Dim> moment{};
  double size = 0;
  for (std::size_t b = 0; b < s.work.blocks.size(); ++b) {
    for (std::size_t slot = b * block_nodes<Dim>; slot < (b + 1) * block_nodes<Dim>; ++slot) {
      Vec<Dim> f;
      for (int k = 0; k < Dim; ++k) f[k] = s.work.nodes.force[slot][k];
      const Vec<Dim> arm = s.node_position(b, slot) - s.centre;
      force += f;
      for (int k = 0; k < Dim; ++k) moment[k] += arm * f[k];
      size += norm(f);
    }
  }
  EXPECT_GT(size, 1e4);
  EXPECT_LT(norm(force), 1e-11 * size);
  for (const Vec<Dim>& m : moment) EXPECT_LT(norm(m), 1e-11 * size);
}

TYPED_TEST(CrackMotion, ImagesInMirrorsKeepAboveAbove) {
  constexpr int Dim = TestFixture::dimension;
  for (int axis = 0; axis < Dim; ++axis) {
    CrackedSolid<Dim> s;
    Crack<Dim>& crack = s.crack();
    // Half a cell beside the crack, so that it is near without ending there.
    double least = std::numeric_limits<double>::infinity();
    for (const Vec<Dim>& x : crack.plane) least = std::min(least, x[axis]);
    SymmetryPlane mirror;
    mirror.axis = axis;
    mirror.at = least - 0.5 * s.model.grid.cell[axis];
    s.model.symmetries = {mirror};
    view_cracks(s.state, s.work, s.model, 1);
    const CrackView<Dim>& view = s.work.crack_view;
    ASSERT_EQ(view.seen.size(), 2u);
    EXPECT_EQ(seen_in_mirror(view, 0, 0), 1u);
    EXPECT_EQ(seen_in_mirror(view, 1, 0), 0u);
    const CrackMesh<Dim>&whole = view.meshes[0], &image = view.meshes[1];
    ASSERT_EQ(image.facets.size(), whole.facets.size());
    const Vec<Dim> up_there = [&] {
      Vec<Dim> n = s.up;
      n[axis] = -n[axis];
      return n;
    }();
    for (std::size_t f = 0; f < image.facets.size(); ++f) {
      EXPECT_LT(norm(whole.normals[f] + s.up), 1e-12);
      EXPECT_LT(norm(image.normals[f] + up_there), 1e-12);
      EXPECT_LT(norm(facet_normal<Dim>(image.vertices, image.facets[f]) - image.normals[f]), 1e-12) << "turned as its vertices say";
    }
    // As many ends as the crack has.
    const auto ends = [](const CrackMesh<Dim>& mesh) {
      int count = 0;
      for (const FacetNeighbours<Dim>& of_facet : mesh.neighbours) count += std::count(of_facet.begin(), of_facet.end(), no_facet);
      return count;
    };
    EXPECT_EQ(ends(whole), Dim == 2 ? 2 : 24);
    EXPECT_EQ(ends(image), ends(whole));
    // Both are listed where they lie.
    for (const Vec<Dim>& x : {whole.vertices[0], image.vertices[0]}) {
      IndexVector<Dim> cell{};
      for (int k = 0; k < Dim; ++k) cell[k] = static_cast<int>(std::floor((x[k] - s.model.grid.origin[k]) * s.model.grid.inverse_cell[k]));
      EXPECT_FALSE(view.bins.facets_of_cell(cell).empty());
    }
  }
}

}  // namespace
}  // namespace crampon
