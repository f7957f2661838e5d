#pragma once
/// Columns of history.csv as the tables of observers declare them (observer.hpp).

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crampon/output/frame.hpp"

namespace crampon {

/// A column of history.csv, or several that differ in a name or an axis.
struct ColumnDescription {
  std::string pattern;  ///< "kinetic_energy", "reaction_AXIS.NAME"; "PROBE.QUANTITY" stands for any other name with a dot
  std::string unit;     ///< empty: that of the quantity
  std::string meaning, formula;
};

/// The axes for which a column is repeated: none; those of space; those about which things turn, z alone in the plane.
enum class Axes { none, of_space, of_turning };

/// A line of an observer's table. Facts: what the observer has found at the present time, of one thing where there are several.
template <class Facts>
struct Column {
  ColumnDescription is;
  double (*get)(const Facts&, int axis);
  Axes axes = Axes::none;
  bool (*is_shown)(const Facts&) = nullptr;  ///< null: always
};

/// Where observers put cells: the header of the history and its rows come from the same walk, so that no value can stand under another's name.
class Cells {
 public:
  enum class Of { header, row };
  explicit Cells(Of of) : of_(of) {}

  /// All columns of a table for one thing; thing: what the input calls it, in place of NAME.
  template <int Dim, class Facts>
  void add(const std::vector<Column<Facts>>& table, const Facts& facts, std::string_view thing = {}) {
    for (const Column<Facts>& column : table) {
      if (column.is_shown && !column.is_shown(facts)) continue;
      const int first = column.axes == Axes::of_turning && Dim == 2 ? 2 : 0;
      int end = Dim;
      if (column.axes == Axes::none) end = 1;
      if (column.axes == Axes::of_turning) end = 3;
      for (int axis = first; axis < end; ++axis) {
        if (of_ == Of::header)
          columns_.push_back({named(column.is.pattern, axis, thing), column.is.unit});
        else
          row_.push_back(column.get(facts, axis));
      }
    }
  }
  void add(HistoryColumn column, double value) {
    if (of_ == Of::header)
      columns_.push_back(std::move(column));
    else
      row_.push_back(value);
  }

  std::vector<HistoryColumn> columns() && { return std::move(columns_); }
  std::vector<double> row() && { return std::move(row_); }

 private:
  static std::string named(std::string pattern, int axis, std::string_view thing) {
    if (const std::size_t at = pattern.find("AXIS"); at != std::string::npos) pattern.replace(at, 4, 1, "xyz"[axis]);
    if (const std::size_t at = pattern.find("NAME.END"); at != std::string::npos) return pattern.replace(at, 8, thing);
    if (const std::size_t at = pattern.find("NAME"); at != std::string::npos) pattern.replace(at, 4, thing);
    return pattern;
  }

  Of of_;
  std::vector<HistoryColumn> columns_;
  std::vector<double> row_;
};

/// The descriptions of a table.
template <class Facts>
std::vector<ColumnDescription> descriptions_in(const std::vector<Column<Facts>>& table) {
  std::vector<ColumnDescription> all;
  for (const Column<Facts>& column : table) all.push_back(column.is);
  return all;
}

}  // namespace crampon
