#include "crampon/crack/facet_bins.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crampon {

namespace {

// In cells. Far above the rounding of a coordinate in cells (1e-12 at 10^4 cells) and of a particle's cell by floor().
constexpr double margin = 1e-9;

/// A cell number from a coordinate that may lie far outside the grid.
int clamp_to_int(double x, int low, int high) { return x <= low ? low : x >= high ? high : static_cast<int>(x); }

}  // namespace

void FacetBins::collect_runs(const BinGrid& grid, std::span<const CrackPath> cracks) {
  runs_.clear();
  // The segment meets the box of cell (i, j) when cell (i, j) meets the segment's points widened by these.
  const double down = 1 + grid.reach_high + margin, up = grid.reach_low + margin;
  const int last_cell[2] = {grid.cells[0] + padding - 1, grid.cells[1] + padding - 1};
  const Vec<2> per_cell{1 / grid.cell[0], 1 / grid.cell[1]};
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    for (std::size_t s = 0; s < cracks[c].segment_count(); ++s) {
      Vec<2> a = cracks[c].vertices[s] - grid.origin, b = cracks[c].vertices[s + 1] - grid.origin;
      for (int k = 0; k < 2; ++k) {
        a[k] *= per_cell[k];
        b[k] *= per_cell[k];
      }
      if (!std::isfinite(a[0] + b[0]) || !std::isfinite(a[1] + b[1])) continue;
      if (a[1] > b[1]) std::swap(a, b);
      const double rise = b[1] - a[1], run = b[0] - a[0];
      const int row_first = clamp_to_int(std::ceil(a[1] - down), -padding, last_cell[1] + 1);
      const int row_last = clamp_to_int(std::floor(b[1] + up), -padding - 1, last_cell[1]);
      for (int j = row_first; j <= row_last; ++j) {
        // The part of the segment between the lowest and the highest line that cell row j can see.
        const double low = j - up, high = j + down;
        const double x_low = a[1] >= low ? a[0] : a[0] + run * std::fmin((low - a[1]) / rise, 1.);
        const double x_high = b[1] <= high ? b[0] : a[0] + run * std::fmin((high - a[1]) / rise, 1.);
        const int first = clamp_to_int(std::ceil(std::fmin(x_low, x_high) - down), -padding, last_cell[0] + 1);
        const int last = clamp_to_int(std::floor(std::fmax(x_low, x_high) + up), -padding - 1, last_cell[0]);
        if (first > last) continue;
        runs_.push_back({j + padding, first, last, {static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(s)}});
      }
    }
  }
}

void FacetBins::build(const BinGrid& grid, std::span<const CrackPath> cracks) {
  width_ = std::int64_t{grid.cells[0]} + 2 * padding;
  reach_low_ = grid.reach_low;
  reach_high_ = grid.reach_high;
  collect_runs(grid, cracks);
  rows_.assign(static_cast<std::size_t>(grid.cells[1] + 2 * padding), Row{});
  for (const Run& run : runs_) {
    Row& row = rows_[static_cast<std::size_t>(run.row)];
    if (row.first > row.last) {
      row.first = run.first;
      row.last = run.last;
    } else {
      row.first = std::min(row.first, run.first);
      row.last = std::max(row.last, run.last);
    }
  }
  std::size_t lists = 0;
  for (Row& row : rows_) {
    row.begin = lists;
    if (row.first <= row.last) lists += static_cast<std::size_t>(row.last - row.first) + 1;
  }
  // A counting sort by list, stable, so each list keeps the order of the runs: crack, then segment.
  starts_.assign(lists + 2, 0);
  for (const Run& run : runs_) {
    const std::size_t begin = rows_[static_cast<std::size_t>(run.row)].list(run.first) + 2;
    for (std::size_t k = begin; k <= begin + static_cast<std::size_t>(run.last - run.first); ++k) ++starts_[k];
  }
  std::uint64_t total = 0;
  for (std::uint32_t& n : starts_) {
    total += n;
    n = static_cast<std::uint32_t>(total);
  }
  if (total > UINT32_MAX) throw std::length_error("crack segments seen from more than 2^32 cells in all");
  facets_.resize(total);
  // Now list k begins at starts_[k + 1]; filling moves that to where it ends, which is where list k + 1 begins.
  for (const Run& run : runs_) {
    const std::size_t begin = rows_[static_cast<std::size_t>(run.row)].list(run.first) + 1;
    for (std::size_t k = begin; k <= begin + static_cast<std::size_t>(run.last - run.first); ++k) facets_[starts_[k]++] = run.facet;
  }
}

std::span<const FacetRef> FacetBins::facets_of_box(std::array<int, 2> low, std::array<int, 2> high, std::vector<FacetRef>& room) const {
  const int seen = reach_low_ + reach_high_;  // cells beside its own that one cell sees
  if (high[0] - low[0] <= seen && high[1] - low[1] <= seen) return facets_of_cell(low[0] + reach_low_, low[1] + reach_low_);
  room.clear();
  const int j_last = std::min(high[1], static_cast<int>(rows_.size()) - padding - 1);
  for (int j = std::max(low[1], -padding); j <= j_last; ++j) {
    const Row& row = rows_[static_cast<std::size_t>(j + padding)];
    const int first = std::max(low[0], row.first), last = std::min(high[0], row.last);
    if (first > last) continue;
    room.insert(room.end(), facets_.begin() + starts_[row.list(first)], facets_.begin() + starts_[row.list(last) + 1]);
  }
  std::sort(room.begin(), room.end());
  room.erase(std::unique(room.begin(), room.end()), room.end());
  return room;
}

bool FacetBins::any_in_box(const std::array<int, 2>& low, const std::array<int, 2>& high) const {
  if (facets_.empty()) return false;
  const int j_last = std::min(high[1], static_cast<int>(rows_.size()) - padding - 1);
  for (int j = std::max(low[1], -padding); j <= j_last; ++j) {
    const Row& row = rows_[static_cast<std::size_t>(j + padding)];
    const int first = std::max(low[0], row.first), last = std::min(high[0], row.last);
    if (first > last) continue;
    if (starts_[row.list(first)] != starts_[row.list(last) + 1]) return true;
  }
  return false;
}

}  // namespace crampon
