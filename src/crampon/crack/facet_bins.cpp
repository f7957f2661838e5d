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

/// Cells along one axis that see something of a facet.
struct CellRange {
  int first, last;

  /// The facet lies between `low` and `high`, in cells, and is seen by a cell that meets this range widened by `down` and `up`.
  CellRange(double low, double high, double down, double up, int padding, int last_cell)
      : first(clamp_to_int(std::ceil(low - down), -padding, last_cell + 1)),
        last(clamp_to_int(std::floor(high + up), -padding - 1, last_cell)) {}
};

/// The vertices of a facet in cells from the grid's origin; false when one of them is not finite.
template <int Dim>
bool corners_in_cells(const CrackMesh<Dim>& crack, const Facet<Dim>& facet, const BinGrid<Dim>& grid, const Vec<Dim>& per_cell,
                      std::array<Vec<Dim>, Dim>& corners) {
  Vec<Dim> sum{};
  for (std::size_t v = 0; v < Dim; ++v) {
    corners[v] = crack.vertices[facet[v]] - grid.origin;
    for (int k = 0; k < Dim; ++k) corners[v][k] *= per_cell[k];
    sum += corners[v];
  }
  for (int k = 0; k < Dim; ++k) {
    if (!std::isfinite(sum[k])) return false;
  }
  return true;
}

}  // namespace

template <int Dim>
void FacetBins<Dim>::collect_runs(const BinGrid<Dim>& grid, std::span<const CrackMesh<Dim>> cracks) {
  runs_.clear();
  // The facet meets the box of a cell when the cell meets the facet's points widened by these.
  const double down = 1 + grid.reach_high + margin, up = grid.reach_low + margin;
  Vec<Dim> per_cell;
  for (int k = 0; k < Dim; ++k) per_cell[k] = 1 / grid.cell[k];
  const auto range = [&](int axis, double low, double high) {
    return CellRange(low, high, down, up, padding, grid.cells[axis] + padding - 1);
  };
  std::array<Vec<Dim>, Dim> corners;
  for (std::uint32_t c = 0; c < cracks.size(); ++c) {
    for (FacetId f = 0; f < cracks[c].facets.size(); ++f) {
      if (!corners_in_cells<Dim>(cracks[c], cracks[c].facets[f], grid, per_cell, corners)) continue;
      const auto add_run = [&](int row, const CellRange& cells) {
        if (cells.first <= cells.last) runs_.push_back({row, cells.first, cells.last, {c, f}});
      };
      if constexpr (Dim == 2) {
        Vec<2>&a = corners[0], &b = corners[1];
        if (a[1] > b[1]) std::swap(a, b);
        const double rise = b[1] - a[1], run = b[0] - a[0];
        const CellRange rows = range(1, a[1], b[1]);
        for (int j = rows.first; j <= rows.last; ++j) {
          // The part of the segment between the lowest and the highest line that cell row j can see.
          const double low = j - up, high = j + down;
          const double x_low = a[1] >= low ? a[0] : a[0] + run * std::fmin((low - a[1]) / rise, 1.);
          const double x_high = b[1] <= high ? b[0] : a[0] + run * std::fmin((high - a[1]) / rise, 1.);
          add_run(j + padding, range(0, std::fmin(x_low, x_high), std::fmax(x_low, x_high)));
        }
      } else {
        // Triangles are no longer than a cell or two, so that the box about one is seen by few cells that do not see the triangle itself.
        Vec<3> low = corners[0], high = corners[0];
        for (const Vec<3>& x : corners) {
          for (int k = 0; k < 3; ++k) low[k] = std::fmin(low[k], x[k]), high[k] = std::fmax(high[k], x[k]);
        }
        const CellRange along = range(0, low[0], high[0]), rows = range(1, low[1], high[1]), layers = range(2, low[2], high[2]);
        for (int k = layers.first; k <= layers.last; ++k) {
          for (int j = rows.first; j <= rows.last; ++j) add_run((k + padding) * rows_along_[1] + j + padding, along);
        }
      }
    }
  }
}

template <int Dim>
void FacetBins<Dim>::build(const BinGrid<Dim>& grid, std::span<const CrackMesh<Dim>> cracks) {
  reach_low_ = grid.reach_low;
  reach_high_ = grid.reach_high;
  std::size_t rows = 1;
  for (int k = 1; k < Dim; ++k) {
    rows_along_[k] = grid.cells[k] + 2 * padding;
    rows *= static_cast<std::size_t>(rows_along_[k]);
  }
  collect_runs(grid, cracks);
  rows_.assign(rows, Row{});
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
  // A counting sort by list, stable, so each list keeps the order of the runs: crack, then facet.
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
  if (total > UINT32_MAX) throw std::length_error("facets of cracks seen from more than 2^32 cells in all");
  facets_.resize(total);
  // Now list k begins at starts_[k + 1]; filling moves that to where it ends, which is where list k + 1 begins.
  for (const Run& run : runs_) {
    const std::size_t begin = rows_[static_cast<std::size_t>(run.row)].list(run.first) + 1;
    for (std::size_t k = begin; k <= begin + static_cast<std::size_t>(run.last - run.first); ++k) facets_[starts_[k]++] = run.facet;
  }
}

template <int Dim>
template <class F>
bool FacetBins<Dim>::any_row(const Cell& low, const Cell& high, F f) const {
  const auto first_of = [&](int axis) { return std::max(low[axis], -padding); };
  const auto last_of = [&](int axis) { return std::min(high[axis], rows_along_[axis] - padding - 1); };
  const int k_first = Dim == 3 ? first_of(Dim - 1) : 0, k_last = Dim == 3 ? last_of(Dim - 1) : 0;
  const int j_first = first_of(1), j_last = last_of(1);
  for (int k = k_first; k <= k_last; ++k) {
    for (int j = j_first; j <= j_last; ++j) {
      const int number = (Dim == 3 ? (k + padding) * rows_along_[1] : 0) + j + padding;
      const Row& row = rows_[static_cast<std::size_t>(number)];
      const int first = std::max(low[0], row.first), last = std::min(high[0], row.last);
      if (first <= last && f(row, first, last)) return true;
    }
  }
  return false;
}

template <int Dim>
std::span<const FacetRef> FacetBins<Dim>::facets_of_box(const Cell& low, const Cell& high, std::vector<FacetRef>& room) const {
  const int seen = reach_low_ + reach_high_;  // cells beside its own that one cell sees
  bool small = true;
  Cell middle;
  for (int k = 0; k < Dim; ++k) {
    small = small && high[k] - low[k] <= seen;
    middle[k] = low[k] + reach_low_;
  }
  if (small) return facets_of_cell(middle);
  room.clear();
  any_row(low, high, [&](const Row& row, int first, int last) {
    room.insert(room.end(), facets_.begin() + starts_[row.list(first)], facets_.begin() + starts_[row.list(last) + 1]);
    return false;
  });
  std::sort(room.begin(), room.end());
  room.erase(std::unique(room.begin(), room.end()), room.end());
  return room;
}

template <int Dim>
bool FacetBins<Dim>::any_in_box(const Cell& low, const Cell& high) const {
  if (facets_.empty()) return false;
  return any_row(low, high, [&](const Row& row, int first, int last) { return starts_[row.list(first)] != starts_[row.list(last) + 1]; });
}

template class FacetBins<2>;
template class FacetBins<3>;

}  // namespace crampon
