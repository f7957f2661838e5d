// Facets of cracks: their normals, and which of them meet (docs/theory/space.md, cracks in memory).

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "crampon/crack/crack_mesh.hpp"
#include "crossing_cases.hpp"

namespace crampon {
namespace {

using namespace crampon::testing;

/// A surface of n by n squares, each cut into two triangles, bent at random: z is a function of x and y. Above is at larger z.
struct Sheet {
  std::vector<Vec<3>> vertices;
  std::vector<Facet<3>> facets;
  Sheet(Rng& rng, VertexId n) {
    for (VertexId j = 0; j <= n; ++j) {
      for (VertexId i = 0; i <= n; ++i) vertices.push_back({{i + draw(rng, -0.2, 0.2), j + draw(rng, -0.2, 0.2), draw(rng, -1, 1)}});
    }
    for (VertexId j = 0; j < n; ++j) {
      for (VertexId i = 0; i < n; ++i) {
        const VertexId a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
        facets.push_back({a, b, c});
        facets.push_back({c, d, a});
      }
    }
    std::shuffle(facets.begin(), facets.end(), rng);
    for (Facet<3>& facet : facets) std::rotate(facet.begin(), facet.begin() + pick(rng, 0, 2), facet.end());
  }
};

TEST(CrackMesh, NormalsPointFromAboveToBelow) {
  const std::vector<Vec<2>> path{{{0, 0}}, {{3, 4}}};  // above is to the left
  EXPECT_LT(norm(facet_normals<2>(path, path_facets(2)).front() - Vec<2>{{0.8, -0.6}}), 1e-15);
  Rng rng(1);
  const Sheet sheet(rng, 6);
  const std::vector<Vec<3>> normals = facet_normals<3>(sheet.vertices, sheet.facets);
  Vec<3> whole;
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const Facet<3>& facet = sheet.facets[f];
    const Vec<3> n = normals[f];
    EXPECT_NEAR(norm(n), 1, 1e-15);
    EXPECT_LT(n[2], 0);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(dot(n, sheet.vertices[facet[(k + 1) % 3]] - sheet.vertices[facet[k]]), 0, 1e-15);
    whole += area_vector<3>(sheet.vertices, facet);
  }
  // Area vectors add up to what the outline of the sheet alone determines: half the sum of x cross dx along it.
  std::map<std::pair<VertexId, VertexId>, int> edges;
  for (const Facet<3>& f : sheet.facets) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{f[k], f[(k + 1) % 3]}];
  }
  Vec<3> outline;
  for (const auto& [edge, times] : edges) {
    ASSERT_EQ(times, 1);
    if (edges.contains({edge.second, edge.first})) continue;
    const Vec<3>&a = sheet.vertices[edge.first], &b = sheet.vertices[edge.second];
    outline += Vec<3>{{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}} * -0.5;
  }
  EXPECT_LT(norm(whole - outline), 1e-12);  // sums of a hundred numbers of the size of ten
}

TEST(CrackMesh, TrianglesMeetAtTheirEdges) {
  Rng rng(2);
  for (int k = 0; k < 20; ++k) {
    const auto n = static_cast<VertexId>(pick(rng, 1, 6));
    const Sheet sheet(rng, n);
    const auto neighbours = find_neighbours<3>(sheet.facets, sheet.vertices.size());
    ASSERT_EQ(neighbours.size(), sheet.facets.size());
    unsigned ends = 0;
    for (FacetId f = 0; f < sheet.facets.size(); ++f) {
      for (std::size_t e = 0; e < 3; ++e) {
        const VertexId a = sheet.facets[f][e], b = sheet.facets[f][(e + 1) % 3];
        const FacetId other = neighbours[f][e];
        if (other == no_facet) {
          ++ends;
          continue;
        }
        // Who lies beyond the edge runs along it the other way, and finds its way back.
        bool found = false;
        for (std::size_t back = 0; back < 3; ++back) {
          const Facet<3>& there = sheet.facets[other];
          if (there[back] != b || there[(back + 1) % 3] != a) continue;
          found = true;
          ASSERT_EQ(neighbours[other][back], f);
        }
        ASSERT_TRUE(found);
      }
    }
    ASSERT_EQ(ends, 4 * n) << "edges on the outline of the sheet";
  }
}

TEST(CrackMesh, SegmentsMeetAtTheirVertices) {
  const std::vector<Facet<2>> path = path_facets(5);
  const auto open = find_neighbours<2>(path, 5), closed = find_neighbours<2>(path, 5, true);
  const std::vector<FacetNeighbours<2>> in_line{{no_facet, 1}, {0, 2}, {1, 3}, {2, no_facet}}, in_ring{{3, 1}, {0, 2}, {1, 3}, {2, 0}};
  EXPECT_EQ(open, in_line);
  EXPECT_EQ(closed, in_ring);
}

TEST(CrackMesh, RefusesFacetsThatBranchOrTurnRound) {
  const std::vector<Facet<3>> branch{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, turned{{0, 1, 2}, {0, 1, 3}}, fine{{0, 1, 2}, {1, 0, 3}};
  EXPECT_THROW(find_neighbours<3>(branch, 5), std::invalid_argument);
  EXPECT_THROW(find_neighbours<3>(turned, 4), std::invalid_argument);
  EXPECT_NO_THROW(find_neighbours<3>(fine, 4));
  const std::vector<Facet<2>> fork{{0, 1}, {1, 2}, {1, 3}};
  EXPECT_THROW(find_neighbours<2>(fork, 4), std::invalid_argument);
}

}  // namespace
}  // namespace crampon
