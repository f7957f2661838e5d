#pragma once
/// Which facets of cracks can the particles of a cell see? (docs/theory/crossing.md, which facets are tested)

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/crack/crack_mesh.hpp"

namespace crampon {

/// The grid as the bins need it. Cell (i, j, k) covers origin + [i, i + 1] x [j, j + 1] x [k, k + 1] cells; a particle in it has its nodes within
/// origin + [i - reach_low, i + 1 + reach_high] x (the same in j and k). Linear shape functions reach 0, 0.
template <int Dim>
struct BinGrid {
  Vec<Dim> origin;               ///< m
  Vec<Dim> cell;                 ///< m
  std::array<int, Dim> cells{};  ///< number of cells per axis
  int reach_low = 0, reach_high = 0;
};

/// Facets binned to cells, rebuilt each step. The cells kept go from -padding to cells + padding - 1 on every axis.
template <int Dim>
class FacetBins {
 public:
  using Cell = std::array<int, Dim>;
  static constexpr int padding = 16;

  /// Every facet is listed in each cell whose box of particles and nodes it meets (with a margin of 1e-9 cells). In the plane it is listed in no
  /// other; in space it is listed in all that the box about it meets. Lists are in the order of (crack, facet). A facet with a
  /// coordinate that is not finite is left out. Throws std::length_error when lists have more than 2^32 entries in all.
  void build(const BinGrid<Dim>& grid, std::span<const CrackMesh<Dim>> cracks);

  bool empty() const { return facets_.empty(); }
  /// Facets seen from any cell; sorted by crack, then facet.
  std::span<const FacetRef> facets_of_cell(const Cell& cell) const {
    int r = cell[Dim - 1] + padding;
    if (r < 0 || r >= rows_along_[Dim - 1]) return {};
    if constexpr (Dim == 3) {
      const int j = cell[1] + padding;
      if (j < 0 || j >= rows_along_[1]) return {};
      r = r * rows_along_[1] + j;
    }
    const Row& row = rows_[static_cast<std::size_t>(r)];
    if (cell[0] < row.first || cell[0] > row.last) return {};
    const std::uint32_t* start = starts_.data() + row.list(cell[0]);
    return {facets_.data() + start[0], facets_.data() + start[1]};
  }
  /// Facets that a line within the cells low..high, both included, can meet, and others about; sorted by crack, then facet. They may lie in
  /// `room`, until it is next used.
  std::span<const FacetRef> facets_of_box(const Cell& low, const Cell& high, std::vector<FacetRef>& room) const;
  /// Does any cell of the box, both corners included, see a facet?
  bool any_in_box(const Cell& low, const Cell& high) const;

 private:
  /// Cells first..last of one row of cells along the first axis have the lists begin, begin + 1, ...; list k is
  /// facets_[starts_[k]..starts_[k + 1]).
  struct Row {
    int first = 0, last = -1;
    std::size_t begin = 0;
    std::size_t list(int i) const { return begin + static_cast<std::size_t>(i - first); }
  };
  /// Neighbouring cells of one row that see the same facet.
  struct Run {
    int row, first, last;
    FacetRef facet;
  };
  void collect_runs(const BinGrid<Dim>& grid, std::span<const CrackMesh<Dim>> cracks);
  /// f(row, first, last) for every row with lists of the box, with the cells of it that are in the box; true when f once was, and then no further.
  template <class F>
  bool any_row(const Cell& low, const Cell& high, F f) const;

  int reach_low_ = 0, reach_high_ = 0;
  Cell rows_along_{};  ///< per axis but the first, how many rows lie side by side
  std::vector<Row> rows_;
  std::vector<std::uint32_t> starts_;
  std::vector<FacetRef> facets_;
  std::vector<Run> runs_;  // scratch, kept for its memory
};

}  // namespace crampon
