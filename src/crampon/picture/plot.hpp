#pragma once
/// Line plots (PNG): history columns over time or each other, and profiles from arrays.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crampon/output/history.hpp"
#include "crampon/picture/box.hpp"

namespace crampon {

enum class CurveStyle { line, marks };

/// Points of one curve, SI; NaN interrupts it. A point alone between two NaN is drawn as a dot.
struct Curve {
  std::string label;
  std::vector<double> x, y;
  CurveStyle style = CurveStyle::line;
};

struct PlotOptions {
  std::string title{};
  std::string x_name{}, x_unit{}, y_name{}, y_unit{};                      ///< plot_history fills those left empty
  std::optional<double> x_lowest{}, x_highest{}, y_lowest{}, y_highest{};  ///< SI; default: all points
  int width = 1200, height = 720;                                          ///< px; more where that has no room for numbers
};

/// Where the areas of a plot lie, px.
struct PlotMap {
  struct Area {
    double left = 0, top = 0, width = 0, height = 0;
    double x_lowest = 0, x_highest = 1, y_lowest = 0, y_highest = 1;  ///< SI, at its edges
    std::array<double, 2> pixel(double x, double y) const {
      return {left + width * (x - x_lowest) / (x_highest - x_lowest), top + height * (y_highest - y) / (y_highest - y_lowest)};
    }
  };
  int width = 0, height = 0;
  std::vector<Area> areas;  ///< from top to bottom
  std::vector<DrawnText> texts;
};

/// All curves in one area, with a legend above it when there are several. Throws std::invalid_argument (no point to draw, x and y of
/// different lengths) and std::runtime_error "path: reason".
PlotMap plot_profiles(const std::vector<Curve>& curves, const PlotOptions& options, const std::filesystem::path& path);

/// A column of one of several histories.
struct HistoryCurve {
  const History* history = nullptr;
  std::string column;
  std::string label;   ///< empty: the column's name
  std::string over{};  ///< column along the horizontal axis, of the same unit for all curves; empty: the time
};

/// Columns over time or another column; those of different units go to areas above each other that share the axis.
/// Throws as plot_profiles, and std::out_of_range for an unknown column.
PlotMap plot_history(const std::vector<HistoryCurve>& curves, const PlotOptions& options, const std::filesystem::path& path);
PlotMap plot_history(const History& history, const std::vector<std::string>& columns, const PlotOptions& options,
                     const std::filesystem::path& path);

}  // namespace crampon
