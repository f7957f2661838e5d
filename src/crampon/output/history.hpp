#pragma once
/// history.csv: one row of global numbers per chosen time. The header names column and unit, "kinetic_energy[J]".

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crampon/output/frame.hpp"

namespace crampon {

/// Appends rows with 17 significant digits; each row reaches the file system before write_row returns, so a killed run leaves all
/// rows it finished.
class HistoryWriter {
 public:
  /// Creates the file (an old one is replaced) and writes the header. Throws std::runtime_error "path: reason", and
  /// std::invalid_argument for a name that holds a comma, a bracket, a quote or a line break.
  HistoryWriter(std::filesystem::path path, const std::vector<HistoryColumn>& columns);
  ~HistoryWriter();
  HistoryWriter(const HistoryWriter&) = delete;
  HistoryWriter& operator=(const HistoryWriter&) = delete;

  /// One value per column. Throws std::invalid_argument for another count and std::runtime_error when writing fails; a row begun is
  /// then taken back.
  void write_row(const std::vector<double>& row);

 private:
  void write_line(const std::string& line);

  std::filesystem::path path_;
  std::size_t columns_ = 0;
  int file_ = -1;
};

/// What a column did over a range of time.
struct HistoryStatistics {
  double minimum = 0, maximum = 0;
  double mean = 0;    ///< over time: integral of the piecewise linear curve by the length of the range
  double spread = 0;  ///< maximum - minimum
};

/// A history in memory, by columns.
struct History {
  std::vector<HistoryColumn> columns;
  std::vector<std::vector<double>> values;  ///< values[column][row], SI; column 0 is the time

  std::size_t rows() const { return values.empty() ? 0 : values[0].size(); }
  bool has_column(std::string_view name) const;
  /// Index by the name without its unit. Throws std::out_of_range with the most similar name.
  std::size_t column_index(std::string_view name) const;
  /// The column of this name, else all of which it is the part before the first dot: "J" stands for "J.notch.start" and "J.notch.end". Throws as
  /// column_index.
  std::vector<std::string> columns_of(const std::string& name) const;
  const std::vector<double>& column(std::string_view name) const { return values[column_index(name)]; }
  const std::string& unit(std::string_view name) const { return columns[column_index(name)].unit; }
  /// Value at a time, linear between rows. Throws std::out_of_range when the time lies outside the rows (beyond 1e-9 of their span).
  double value_at(std::string_view name, double time) const;
  /// Over [from, to], ends interpolated. Throws as value_at, and std::invalid_argument when to < from.
  HistoryStatistics statistics(std::string_view name, double from, double to) const;
  /// Adds a column that is computed from others, row by row; unit in SI. Throws std::invalid_argument (what the formula's parser says; a name
  /// that the history has; a name in the formula that it does not have, with the most similar one).
  void add_column(const HistoryColumn& column, const std::string& formula);
};

/// Reads history.csv. A last line without its end (killed run) is left out. Throws std::runtime_error "path:line: reason".
History read_history(const std::filesystem::path& path);

}  // namespace crampon
