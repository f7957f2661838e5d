// Folding at part of a plane against the twin model's crack on the rest of it (conventions 29).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "crampon/core/predicates.hpp"
#include "crampon/crack/crossing.hpp"
#include "crampon/crack/symmetry_fold.hpp"
#include "crossing_cases.hpp"

namespace crampon {
namespace {

using namespace crampon::testing;

/// A point by its coordinates along and away from the plane.
Vec<2> placed(int axis, double along, double away) { return axis == 1 ? Vec<2>{along, away} : Vec<2>{away, along}; }

TEST(SymmetryFold, PairsFoldWhereTheTwinsCrackIsNotCrossed) {
  Rng rng(10);
  int cases = 0, folded = 0, ties = 0;
  for (int k = 0; k < 60000; ++k) {
    const double cell = k % 4 ? 1. / 512 : 0.002, at = 9 * cell;  // coordinates without and with rounding
    const int axis = pick(rng, 0, 1), side = pick(rng, 0, 1) ? 1 : -1;
    const bool on_nodes = pick(rng, 0, 1) != 0, tip_on_node = pick(rng, 0, 1) != 0;
    SymmetryPlane plane;
    plane.axis = axis;
    plane.at = at;
    plane.side = side;
    const int other = 1 - axis;
    const auto tip_near = [&](int low, int high) { return pick(rng, low, high) * cell + (tip_on_node ? 0 : draw(rng, -0.5, 0.5) * cell); };
    // The part may end on the left, on the right, or on both sides; the crack covers the rest of the line.
    const int ends = pick(rng, 1, 3);
    double tip[2] = {0, 0};
    std::vector<Polyline> cracks;
    for (int end = 0; end < 2; ++end) {
      if (!(ends & (1 << end))) continue;
      tip[end] = end == 0 ? tip_near(3, 6) : tip_near(6, 9);
      const double away = end == 0 ? -1 : 1;
      std::vector<double> along;
      const double spacing = on_nodes ? cell : 0.37 * cell;
      // On nodes: the nodes' own coordinates beyond the tip, so that vertices and nodes share their bits.
      if (on_nodes) {
        for (int i = 12; i >= 0; --i) {
          const double x = (end == 0 ? 6 - i : 6 + i) * cell;
          if (away * (x - tip[end]) > 0) along.push_back(x);
        }
      } else {
        for (int i = 24; i >= 1; --i) along.push_back(tip[end] + away * spacing * i);
      }
      std::sort(along.begin(), along.end(), [&](double x, double y) { return away * x > away * y; });
      along.push_back(tip[end]);
      Points v;
      for (const double x : along) v.push_back(placed(axis, x, at));
      if (orient_sign(v.front(), v.back(), v.front() + placed(axis, 0, double(side))) < 0) std::reverse(v.begin(), v.end());
      cracks.emplace_back(v);
      (end == 0 ? plane.from : plane.to)[static_cast<std::size_t>(other)] = tip[end];
    }
    // Up to two cells beyond the plane, particles up to two cells above, at quarters (ties with tips on nodes) or anywhere.
    const int row = pick(rng, 1, 2), column = pick(rng, 2, 10);
    const Vec<2> node = placed(axis, column * cell, (9 - side * row) * cell);
    const double up = k % 2 ? pick(rng, 0, 8) * 0.25 : draw(rng, 0, 2), shift = k % 2 ? pick(rng, -8, 8) * 0.25 : draw(rng, -2, 2);
    Vec<2> particle = placed(axis, (column + shift) * cell, (9 + side * up) * cell);
    if (k % 5 == 0) {  // in line with a tip
      const double t = pick(rng, 0, 4) * 0.25, end = tip[(ends & 1) ? 0 : 1];
      particle = placed(axis, end + t * (end - node[static_cast<std::size_t>(other)]), at + side * t * row * cell);
    }
    if (side * (particle[static_cast<std::size_t>(axis)] - at) < 0) continue;
    bool crossed = false;
    for (const Polyline& c : cracks) {
      crossed |= cross_crack(c.mesh(), particle, node).crosses();
      ties += orient_sign(particle, node, c.vertices.front()) == 0 || orient_sign(particle, node, c.vertices.back()) == 0;
    }
    ASSERT_EQ(folds(plane, particle, node), !crossed) << "case " << k;
    ++cases;
    folded += !crossed;
  }
  EXPECT_GT(cases, 50000);
  EXPECT_GT(folded, 10000);
  EXPECT_GT(cases - folded, 10000);
  EXPECT_GT(ties, 500);
}

TEST(SymmetryFold, OnlyNodesStrictlyBeyondFold) {
  SymmetryPlane plane;  // x = 0, body at x > 0
  EXPECT_TRUE(folds<2>(plane, {0.5, 0}, {-1, 3}));
  EXPECT_FALSE(folds<2>(plane, {0.5, 0}, {0, 0}));
  EXPECT_FALSE(folds<2>(plane, {0.5, 0}, {1, 0}));
  EXPECT_FALSE(folds<2>(plane, {-0.5, 0}, {-1, 0}));
  plane.side = -1;
  EXPECT_TRUE(folds<2>(plane, {-0.5, 0}, {1, 3}));
  EXPECT_FALSE(folds<2>(plane, {-0.5, 0}, {-1, 3}));
}

TEST(SymmetryFold, NodesOnThePlaneAreThoseTheCrackLeavesWhole) {
  SymmetryPlane plane;
  plane.axis = 1;
  plane.at = 1;
  plane.from[0] = 2;
  const Polyline crack({{-9, 1}, {0, 1}, {1, 1}, {2, 1}});  // vertices on nodes, tip on node 2
  for (int i = -3; i <= 6; ++i) {
    const Vec<2> node{double(i), 1};
    int crossed = 0;
    for (const double dx : {-0.75, -0.25, 0.25, 0.75}) {
      for (const double dy : {-0.5, 0.5}) crossed += cross_crack(crack.mesh(), node + Vec<2>{dx, dy}, node).crosses();
    }
    EXPECT_EQ(on_plane(plane, node), crossed == 0) << "node " << i;
    EXPECT_FALSE(on_plane(plane, node + Vec<2>{0, 1}));
  }
  plane.to[0] = 4;
  EXPECT_TRUE(on_plane<2>(plane, {4, 1}));
  EXPECT_FALSE(on_plane<2>(plane, {4.5, 1}));
}

TEST(SymmetryFold, RectangularPartInThreeDimensions) {
  Rng rng(11);
  int folded = 0, edges = 0;
  for (int k = 0; k < 20000; ++k) {
    const int axis = pick(rng, 0, 2), side = pick(rng, 0, 1) ? 1 : -1;
    SymmetryPlane plane;
    plane.axis = axis;
    plane.at = 1;
    plane.side = side;
    Vec<3> p, n;
    const auto ax = static_cast<std::size_t>(axis);
    p[ax] = 1 + side * pick(rng, 0, 4) * 0.5;
    n[ax] = 1 - side * pick(rng, 1, 4) * 0.5;
    // p + t (n - p) meets the plane at t = height / (height + depth); compared after multiplying through, exact on this lattice.
    const double height = side * (p[ax] - 1), depth = side * (1 - n[ax]);
    bool expected = true;
    for (std::size_t d = 0; d < 3; ++d) {
      if (d == ax) continue;
      p[d] = pick(rng, -4, 4) * 0.5;
      n[d] = pick(rng, -4, 4) * 0.5;
      plane.from[d] = pick(rng, 0, 3) ? pick(rng, -3, 0) * 0.5 : -INFINITY;
      plane.to[d] = pick(rng, 0, 3) ? pick(rng, 0, 3) * 0.5 : NAN;
      const double met = p[d] * depth + n[d] * height, whole = height + depth;
      if (met < plane.from[d] * whole || met > plane.to[d] * whole) expected = false;
      edges += met == plane.from[d] * whole || met == plane.to[d] * whole;
    }
    ASSERT_EQ(folds(plane, p, n), expected);
    folded += expected;
  }
  EXPECT_GT(folded, 3000);
  EXPECT_GT(edges, 1000);
}

}  // namespace
}  // namespace crampon
