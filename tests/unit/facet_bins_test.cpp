// Binned facets of cracks against all of them (docs/theory/crossing.md, which facets are tested).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "crampon/core/predicates.hpp"
#include "crampon/crack/facet_bins.hpp"
#include "crossing_cases.hpp"

namespace crampon {
namespace {

using namespace crampon::testing;

bool meets_box(const Vec<2>& a, const Vec<2>& b, const Vec<2>& low, const Vec<2>& high) {
  for (int k = 0; k < 2; ++k) {
    if (std::max(a[k], b[k]) < low[k] || std::min(a[k], b[k]) > high[k]) return false;
  }
  int left = 0, right = 0;
  for (const Vec<2>& corner : Points{low, {high[0], low[1]}, high, {low[0], high[1]}}) {
    const int s = orient_sign(a, b, corner);
    left += s > 0;
    right += s < 0;
  }
  return left < 4 && right < 4;  // on one side altogether: apart
}

TEST(FacetBins, ListExactlyTheSegmentsACellCanSee) {
  Rng rng(9);
  long listed = 0, crossings = 0;
  for (int k = 0; k < 150; ++k) {
    BinGrid<2> grid;
    grid.origin = {draw(rng, -1, 1), draw(rng, -1, 1)};
    grid.cell = k % 3 ? Vec<2>{0.5, 0.25} : Vec<2>{0.1, 0.3};
    grid.cells = {pick(rng, 1, 12), pick(rng, 1, 12)};
    grid.reach_low = pick(rng, 0, 2);
    grid.reach_high = pick(rng, 0, 2);
    const auto at = [&](double i, double j) { return Vec<2>{grid.origin[0] + i * grid.cell[0], grid.origin[1] + j * grid.cell[1]}; };
    std::vector<Polyline> cracks;
    for (int c = pick(rng, 1, 3); c > 0; --c) {
      Points v;
      for (int s = pick(rng, 2, 9); s > 0; --s) {
        const bool far = k % 10 == 0;  // reaching out of the padding
        if (k % 2)
          v.push_back(at(pick(rng, -2, 14), pick(rng, -2, 14)));
        else
          v.push_back(at(draw(rng, far ? -60 : -3, far ? 60 : 15), draw(rng, far ? -60 : -3, far ? 60 : 15)));
      }
      cracks.emplace_back(v);
    }
    std::vector<CrackMesh<2>> meshes;
    for (const Polyline& c : cracks) meshes.push_back(c.mesh());
    FacetBins<2> bins;
    bins.build(grid, meshes);
    for (int j = -FacetBins<2>::padding; j < grid.cells[1] + FacetBins<2>::padding; ++j) {
      for (int i = -FacetBins<2>::padding; i < grid.cells[0] + FacetBins<2>::padding; ++i) {
        const std::span<const FacetRef> got = bins.facets_of_cell({i, j});
        ASSERT_TRUE(std::is_sorted(got.begin(), got.end()));
        ASSERT_EQ(bins.any_in_box({i, j}, {i, j}), !got.empty());
        // The box exactly and with twice the margin: in between the bins may do as they like.
        const double lo = grid.reach_low, hi = 1 + grid.reach_high, m = 2e-9;
        std::size_t n = 0;
        for (std::uint32_t c = 0; c < cracks.size(); ++c) {
          for (std::uint32_t s = 0; s + 1 < cracks[c].vertices.size(); ++s) {
            const Vec<2>&a = cracks[c].vertices[s], &b = cracks[c].vertices[s + 1];
            const bool found = std::binary_search(got.begin(), got.end(), FacetRef{c, s});
            n += found;
            if (found) {
              ASSERT_TRUE(meets_box(a, b, at(i - lo - m, j - lo - m), at(i + hi + m, j + hi + m)));
            } else {
              ASSERT_FALSE(meets_box(a, b, at(i - lo, j - lo), at(i + hi, j + hi)));
            }
          }
        }
        ASSERT_EQ(n, got.size());
        listed += static_cast<long>(n);
        // Lines of the cell, through the lists and through everything.
        if (got.empty() && pick(rng, 0, 9) != 0) continue;
        for (int line = 0; line < 3; ++line) {
          const Vec<2> p = at(i + draw(rng, 0, 1), j + draw(rng, 0, 1));
          const int reach_i = pick(rng, -grid.reach_low, 1 + grid.reach_high), reach_j = pick(rng, -grid.reach_low, 1 + grid.reach_high);
          const Vec<2> node = at(i + reach_i, j + reach_j);
          for (std::uint32_t c = 0; c < cracks.size(); ++c) {
            const auto first = std::lower_bound(got.begin(), got.end(), FacetRef{c, 0});
            const auto last = std::lower_bound(got.begin(), got.end(), FacetRef{c + 1, 0});
            const Crossing some = cross_crack(meshes[c], {first, last}, p, node), all = cross_crack(meshes[c], p, node);
            ASSERT_EQ(some.above, all.above);
            ASSERT_EQ(some.below, all.below);
            ASSERT_EQ(some.normal_sum, all.normal_sum);
            crossings += all.crosses();
          }
        }
      }
    }
    for (int box = 0; box < 50; ++box) {
      const std::array<int, 2> low{pick(rng, -20, 20), pick(rng, -20, 20)}, high{low[0] + pick(rng, 0, 8), low[1] + pick(rng, 0, 8)};
      bool any = false;
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) any |= !bins.facets_of_cell({i, j}).empty();
      }
      ASSERT_EQ(bins.any_in_box(low, high), any);
    }
    BinGrid<2> bare = grid;
    bare.reach_low = bare.reach_high = 0;
    FacetBins<2> cells;  // list what meets the cell itself
    cells.build(bare, meshes);
    std::vector<FacetRef> room;
    for (int box = 0; box < 50; ++box) {
      const std::array<int, 2> low{pick(rng, -10, 10), pick(rng, -10, 10)}, high{low[0] + pick(rng, 0, 6), low[1] + pick(rng, 0, 6)};
      const std::span<const FacetRef> got = bins.facets_of_box(low, high, room);
      ASSERT_TRUE(std::is_sorted(got.begin(), got.end(), std::less_equal<>())) << "ascending, none twice";
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          for (const FacetRef& f : cells.facets_of_cell({i, j})) ASSERT_TRUE(std::binary_search(got.begin(), got.end(), f));
        }
      }
    }
  }
  EXPECT_GT(listed, 20000);
  EXPECT_GT(crossings, 5000);
}

TEST(FacetBins, AreEmptyWithoutCracksAndRebuildFromScratch) {
  FacetBins<2> bins;
  EXPECT_TRUE(bins.empty());
  EXPECT_TRUE(bins.facets_of_cell({0, 0}).empty());
  EXPECT_FALSE(bins.any_in_box({-5, -5}, {5, 5}));
  const Polyline crack({{0.5, 0.5}, {2.5, 0.5}}), elsewhere({{7.5, 7.5}, {8.5, 7.5}});
  const BinGrid<2> grid{{0, 0}, {1, 1}, {10, 10}, 0, 0};
  const CrackMesh<2> one[] = {crack.mesh()}, two[] = {elsewhere.mesh()};
  bins.build(grid, one);
  EXPECT_EQ(bins.facets_of_cell({1, 0}).size(), 1u);
  bins.build(grid, two);
  EXPECT_TRUE(bins.facets_of_cell({1, 0}).empty());
  EXPECT_EQ(bins.facets_of_cell({8, 7}).size(), 1u);
  bins.build(grid, {});
  EXPECT_TRUE(bins.empty());
  EXPECT_FALSE(bins.any_in_box({-16, -16}, {26, 26}));
}

/// Triangles that have nothing to do with each other: bins ask no more of a crack.
struct Triangles {
  std::vector<Vec<3>> vertices;
  std::vector<Facet<3>> facets;
  CrackMesh<3> mesh() const { return {vertices, facets, {}}; }
};

TEST(FacetBins, ListTrianglesInEveryCellThatCanSeeThem) {
  Rng rng(10);
  long points = 0, listed = 0;
  for (int k = 0; k < 60; ++k) {
    BinGrid<3> grid;
    for (std::size_t d = 0; d < 3; ++d) {
      grid.origin[d] = draw(rng, -1, 1);
      grid.cell[d] = draw(rng, 0.1, 0.5);
      grid.cells[d] = pick(rng, 1, 7);
    }
    grid.reach_low = pick(rng, 0, 2);
    grid.reach_high = pick(rng, 0, 2);
    const auto in_cells = [&](const Vec<3>& x) {
      Vec<3> g;
      for (std::size_t d = 0; d < 3; ++d) g[d] = (x[d] - grid.origin[d]) / grid.cell[d];
      return g;
    };
    // Some have vertices on nodes, some reach out of the cells that are kept.
    std::vector<Triangles> cracks(static_cast<std::size_t>(pick(rng, 1, 3)));
    for (Triangles& crack : cracks) {
      for (int f = pick(rng, 1, 6); f > 0; --f) {
        Vec<3> corner;
        for (std::size_t d = 0; d < 3; ++d) corner[d] = k % 3 ? draw(rng, -2, 9) : pick(rng, -2, 9);
        const double size = k % 10 == 0 ? 40 : 2;
        for (int v = 0; v < 3; ++v) {
          Vec<3> g = corner;
          for (std::size_t d = 0; d < 3; ++d) g[d] += k % 3 ? draw(rng, -size, size) : pick(rng, -2, 2);
          for (std::size_t d = 0; d < 3; ++d) g[d] = grid.origin[d] + g[d] * grid.cell[d];
          crack.vertices.push_back(g);
        }
        const auto first = static_cast<VertexId>(crack.vertices.size() - 3);
        crack.facets.push_back({first, first + 1, first + 2});
      }
    }
    std::vector<CrackMesh<3>> meshes;
    for (const Triangles& crack : cracks) meshes.push_back(crack.mesh());
    FacetBins<3> bins;
    bins.build(grid, meshes);

    const double lo = grid.reach_low, hi = 1 + grid.reach_high;
    const auto kept = [&](std::size_t d, double i) { return std::clamp<int>(static_cast<int>(i), -16, grid.cells[d] + 15); };
    std::array<int, 3> cell{};
    for (std::uint32_t c = 0; c < cracks.size(); ++c) {
      for (std::uint32_t f = 0; f < cracks[c].facets.size(); ++f) {
        std::array<Vec<3>, 3> corners;
        for (std::size_t v = 0; v < 3; ++v) corners[v] = in_cells(cracks[c].vertices[cracks[c].facets[f][v]]);
        for (int sample = 0; sample < 40; ++sample) {
          const double s = draw(rng, 0, 1), t = draw(rng, 0, 1 - s);
          const Vec<3> g = corners[0] * (1 - s - t) + corners[1] * s + corners[2] * t;
          // Cells whose boxes hold this point of the triangle, safe from rounding.
          std::array<int, 3> low{}, high{};
          for (std::size_t d = 0; d < 3; ++d) {
            low[d] = kept(d, std::ceil(std::clamp(g[d] - hi + 1e-12, -100., 100.)));
            high[d] = kept(d, std::floor(std::clamp(g[d] + lo - 1e-12, -100., 100.)));
            if (g[d] < low[d] - lo || g[d] > high[d] + hi) high[d] = low[d] - 1;  // beyond the padding
          }
          for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
            for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
              for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) {
                const std::span<const FacetRef> got = bins.facets_of_cell(cell);
                ASSERT_TRUE(std::binary_search(got.begin(), got.end(), FacetRef{c, f}));
                ++points;
              }
            }
          }
        }
      }
    }
    for (cell[2] = -18; cell[2] < grid.cells[2] + 18; ++cell[2]) {
      for (cell[1] = -18; cell[1] < grid.cells[1] + 18; ++cell[1]) {
        for (cell[0] = -18; cell[0] < grid.cells[0] + 18; ++cell[0]) {
          const std::span<const FacetRef> got = bins.facets_of_cell(cell);
          if (got.empty()) continue;
          ASSERT_TRUE(std::is_sorted(got.begin(), got.end(), std::less_equal<>())) << "ascending, none twice";
          ASSERT_TRUE(bins.any_in_box(cell, cell));
          for (std::size_t d = 0; d < 3; ++d) ASSERT_TRUE(cell[d] >= -16 && cell[d] < grid.cells[d] + 16);
          // None is listed from afar: its own box comes as near as the cell's.
          for (const FacetRef& at : got) {
            for (std::size_t d = 0; d < 3; ++d) {
              double least = std::numeric_limits<double>::infinity(), most = -least;
              for (const VertexId v : cracks[at.crack].facets[at.facet]) {
                const double g = in_cells(cracks[at.crack].vertices[v])[d];
                least = std::min(least, g), most = std::max(most, g);
              }
              ASSERT_LE(least, cell[d] + hi + 2e-9);
              ASSERT_GE(most, cell[d] - lo - 2e-9);
            }
          }
          listed += static_cast<long>(got.size());
        }
      }
    }
    BinGrid<3> bare = grid;
    bare.reach_low = bare.reach_high = 0;
    FacetBins<3> cells;  // list what meets the cell itself
    cells.build(bare, meshes);
    std::vector<FacetRef> room;
    for (int box = 0; box < 30; ++box) {
      std::array<int, 3> low{}, high{};
      for (std::size_t d = 0; d < 3; ++d) low[d] = pick(rng, -10, 12), high[d] = low[d] + pick(rng, 0, 5);
      const std::vector<FacetRef> got = [&] {
        const std::span<const FacetRef> found = bins.facets_of_box(low, high, room);
        return std::vector<FacetRef>(found.begin(), found.end());
      }();
      ASSERT_TRUE(std::is_sorted(got.begin(), got.end(), std::less_equal<>()));
      bool any = false;
      for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
        for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
          for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) {
            any |= !bins.facets_of_cell(cell).empty();
            for (const FacetRef& f : cells.facets_of_cell(cell)) ASSERT_TRUE(std::binary_search(got.begin(), got.end(), f));
          }
        }
      }
      ASSERT_EQ(bins.any_in_box(low, high), any);
    }
  }
  EXPECT_GT(points, 100000);
  EXPECT_GT(listed, 20000);
}

}  // namespace
}  // namespace crampon
