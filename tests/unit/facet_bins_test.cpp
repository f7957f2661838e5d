// Binned crack segments against all of them (docs/theory/crossing.md, which segments are tested).

#include <gtest/gtest.h>

#include <algorithm>
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
    BinGrid grid;
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
    std::vector<CrackPath> paths;
    for (const Polyline& c : cracks) paths.push_back(c.path());
    FacetBins bins;
    bins.build(grid, paths);
    for (int j = -FacetBins::padding; j < grid.cells[1] + FacetBins::padding; ++j) {
      for (int i = -FacetBins::padding; i < grid.cells[0] + FacetBins::padding; ++i) {
        const std::span<const FacetRef> got = bins.facets_of_cell(i, j);
        ASSERT_EQ(bins.facets_of_cell(bins.cell_key(i, j)).data(), got.data());
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
            const Crossing some = cross_path(paths[c], {first, last}, p, node), all = cross_path(paths[c], p, node);
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
        for (int i = low[0]; i <= high[0]; ++i) any |= !bins.facets_of_cell(i, j).empty();
      }
      ASSERT_EQ(bins.any_in_box(low, high), any);
    }
    BinGrid bare = grid;
    bare.reach_low = bare.reach_high = 0;
    FacetBins cells;  // list what meets the cell itself
    cells.build(bare, paths);
    std::vector<FacetRef> room;
    for (int box = 0; box < 50; ++box) {
      const std::array<int, 2> low{pick(rng, -10, 10), pick(rng, -10, 10)}, high{low[0] + pick(rng, 0, 6), low[1] + pick(rng, 0, 6)};
      const std::span<const FacetRef> got = bins.facets_of_box(low, high, room);
      ASSERT_TRUE(std::is_sorted(got.begin(), got.end(), std::less_equal<>())) << "ascending, none twice";
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          for (const FacetRef& f : cells.facets_of_cell(i, j)) ASSERT_TRUE(std::binary_search(got.begin(), got.end(), f));
        }
      }
    }
  }
  EXPECT_GT(listed, 20000);
  EXPECT_GT(crossings, 5000);
}

TEST(FacetBins, AreEmptyWithoutCracksAndRebuildFromScratch) {
  FacetBins bins;
  EXPECT_TRUE(bins.empty());
  EXPECT_TRUE(bins.facets_of_cell(0, 0).empty());
  EXPECT_TRUE(bins.facets_of_cell(std::int64_t{5}).empty());
  EXPECT_FALSE(bins.any_in_box({-5, -5}, {5, 5}));
  const Polyline crack({{0.5, 0.5}, {2.5, 0.5}}), elsewhere({{7.5, 7.5}, {8.5, 7.5}});
  const BinGrid grid{{0, 0}, {1, 1}, {10, 10}, 0, 0};
  const CrackPath one[] = {crack.path()}, two[] = {elsewhere.path()};
  bins.build(grid, one);
  EXPECT_EQ(bins.facets_of_cell(1, 0).size(), 1u);
  bins.build(grid, two);
  EXPECT_TRUE(bins.facets_of_cell(1, 0).empty());
  EXPECT_EQ(bins.facets_of_cell(8, 7).size(), 1u);
  bins.build(grid, {});
  EXPECT_TRUE(bins.empty());
  EXPECT_FALSE(bins.any_in_box({-16, -16}, {26, 26}));
}

}  // namespace
}  // namespace crampon
