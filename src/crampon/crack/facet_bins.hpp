#pragma once
/// Which crack segments can the particles of a cell see? (docs/theory/crossing.md, which segments are tested)

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/crack/crossing.hpp"

namespace crampon {

/// The grid as the bins need it. Cell (i, j) covers origin + [i, i + 1] x [j, j + 1] cells; a particle in it has its nodes within
/// origin + [i - reach_low, i + 1 + reach_high] x (the same in j). Linear shape functions reach 0, 0.
struct BinGrid {
  Vec<2> origin;               ///< m
  Vec<2> cell;                 ///< m
  std::array<int, 2> cells{};  ///< number of cells per axis
  int reach_low = 0, reach_high = 0;
};

/// Segments binned to cells, rebuilt each step. The cells kept go from -padding to cells + padding - 1 on every axis.
class FacetBins {
 public:
  static constexpr int padding = 16;

  /// Every segment is listed in each cell whose box of particles and nodes it meets (with a margin of 1e-9 cells), and in no other.
  /// Lists are in the order of (crack, segment). A segment with a coordinate that is not finite is left out.
  void build(const BinGrid& grid, std::span<const CrackPath> cracks);

  bool empty() const { return facets_.empty(); }
  /// One number per cell; valid for cells within the padding.
  std::int64_t cell_key(int i, int j) const { return std::int64_t{j + padding} * width_ + (i + padding); }
  /// Segments seen from cell (i, j), any i and j; sorted by crack, then segment.
  std::span<const FacetRef> facets_of_cell(int i, int j) const {
    const int r = j + padding;
    if (r < 0 || r >= static_cast<int>(rows_.size())) return {};
    const Row& row = rows_[static_cast<std::size_t>(r)];
    if (i < row.first || i > row.last) return {};
    const std::uint32_t* start = starts_.data() + row.list(i);
    return {facets_.data() + start[0], facets_.data() + start[1]};
  }
  std::span<const FacetRef> facets_of_cell(std::int64_t key) const {
    if (key < 0 || width_ == 0) return {};
    return facets_of_cell(static_cast<int>(key % width_) - padding, static_cast<int>(key / width_) - padding);
  }
  /// Segments that a line within the cells low..high, both included, can meet, and others about; sorted by crack, then segment. They may lie
  /// in `room`, until it is next used.
  std::span<const FacetRef> facets_of_box(std::array<int, 2> low, std::array<int, 2> high, std::vector<FacetRef>& room) const;
  /// Does any cell of the box, both corners included, see a segment?
  bool any_in_box(const std::array<int, 2>& low, const std::array<int, 2>& high) const;

 private:
  /// Cells first..last of one row of cells have the lists begin, begin + 1, ...; list k is facets_[starts_[k]..starts_[k + 1]).
  struct Row {
    int first = 0, last = -1;
    std::size_t begin = 0;
    std::size_t list(int i) const { return begin + static_cast<std::size_t>(i - first); }
  };
  /// Neighbouring cells of one row that see the same segment.
  struct Run {
    int row, first, last;
    FacetRef facet;
  };
  void collect_runs(const BinGrid& grid, std::span<const CrackPath> cracks);

  std::int64_t width_ = 0;
  int reach_low_ = 0, reach_high_ = 0;
  std::vector<Row> rows_;
  std::vector<std::uint32_t> starts_;
  std::vector<FacetRef> facets_;
  std::vector<Run> runs_;  // scratch, kept for its memory
};

}  // namespace crampon
