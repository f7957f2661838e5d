#pragma once
/// Numbers along an axis or a colour bar, as many as stand beside each other without touching.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "crampon/picture/display_scale.hpp"

namespace crampon {

/// What an axis shows, and where.
struct Axis {
  struct Mark {
    double value = 0;   ///< SI
    std::string label;  ///< empty: a line alone
  };
  std::vector<Mark> marks;
  std::string title;  ///< "stress xx (kPa)"; "time − 1.2 s (µs)" where the numbers would be long ones that differ in their last digits
  double width = 0;   ///< of the widest label, px
};

/// An axis to label.
struct AxisRange {
  double lowest = 0, highest = 1;  ///< SI
  std::string name, unit;
  std::optional<double> largest{};  ///< absolute value that chooses the prefix, SI, for axes that share one; left out: of the ends
};

enum class Direction { across, upwards };

/// How wide labels come out, px, and their size.
struct LabelFont {
  std::function<double(const std::string&)> width;
  double size = 17;
};

/// length: of the axis, px. overhang: how far a label may reach beyond its ends, px.
Axis label_axis(const AxisRange& range, Direction direction, double length, double overhang, const LabelFont& font);

}  // namespace crampon
