#include "crampon/picture/axis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace crampon {
namespace {

// What is taken off all numbers before they are shown, SI: a round one, so that it reads shortly.
double offset_of(double lowest, double highest, double step) {
  constexpr double most_steps = 1e5;  // a label of up to five digits is read at a glance
  const double largest = std::max(std::abs(lowest), std::abs(highest));
  if (lowest <= 0 && highest >= 0) return 0;
  if (largest < most_steps * step) return 0;
  const double unit = std::pow(10., std::ceil(std::log10(highest - lowest)));
  const double nearest = lowest > 0 ? lowest : highest, rounding = std::copysign(1e-6, nearest);
  return std::trunc(nearest / unit + rounding) * unit;
}

std::string title_of(const AxisRange& range, double offset, const DisplayScale& scale) {
  if (offset == 0) return label_with_unit(range.name, scale.unit);
  const DisplayScale whole = display_scale(std::abs(offset), range.unit);
  const std::string less = fmt::format("{} {} {:.15g}{}{}", range.name, offset > 0 ? "−" : "+", std::abs(offset) / whole.factor,
                                       whole.unit.empty() ? "" : " ", whole.unit);
  return label_with_unit(less, scale.unit);
}

Axis axis_with(const AxisRange& range, int most) {
  const double step = round_ticks(range.lowest, range.highest, most).step;
  const double offset = offset_of(range.lowest, range.highest, step);
  const double low = range.lowest - offset, high = range.highest - offset;
  const double largest = std::max(std::abs(low), std::abs(high));
  const DisplayScale scale = display_scale(offset == 0 ? range.largest.value_or(largest) : largest, range.unit);
  const Ticks ticks = round_ticks(low / scale.factor, high / scale.factor, most);
  Axis axis;
  for (const double t : ticks.at) axis.marks.push_back({t * scale.factor + offset, tick_label(t, ticks.step)});
  axis.title = title_of(range, offset, scale);
  return axis;
}

bool labels_touch(const Axis& axis, const AxisRange& range, Direction direction, double length, const LabelFont& font) {
  const double apart = (direction == Direction::across ? 0.8 : 0.5) * font.size;
  double last_end = -INFINITY;
  for (const Axis::Mark& mark : axis.marks) {
    const double size = direction == Direction::across ? font.width(mark.label) : font.size;
    const double middle = length * (mark.value - range.lowest) / (range.highest - range.lowest);
    if (middle - size / 2 < last_end + apart) return true;
    last_end = middle + size / 2;
  }
  return false;
}

}  // namespace

Axis label_axis(const AxisRange& range, Direction direction, double length, double overhang, const LabelFont& font) {
  const double usual = length / ((direction == Direction::across ? 4.5 : 3) * font.size);
  std::optional<Axis> fitting;
  const auto try_with = [&](int most) {
    Axis axis = axis_with(range, most);
    if (labels_touch(axis, range, direction, length, font)) return;
    if (!fitting || axis.marks.size() > fitting->marks.size()) fitting = std::move(axis);
  };
  const auto is_scale = [&] { return fitting && fitting->marks.size() >= 2; };
  const int first = std::clamp(static_cast<int>(usual), 2, 12);
  for (int most = first; most >= 1 && !is_scale(); --most) try_with(most);
  for (int most = first + 1; most <= 2 * first && !is_scale(); ++most) try_with(most);  // a lone number is no scale
  if (!fitting) {                                                                       // a lone number is better than none
    fitting = axis_with(range, 1);
    fitting->marks.resize(std::min<std::size_t>(1, fitting->marks.size()));
  }
  for (Axis::Mark& mark : fitting->marks) {
    const double size = direction == Direction::across ? font.width(mark.label) : font.size;
    const double middle = length * (mark.value - range.lowest) / (range.highest - range.lowest);
    if (middle - size / 2 < -overhang - 1 || middle + size / 2 > length + overhang + 1) mark.label.clear();
    if (direction == Direction::upwards) fitting->width = std::max(fitting->width, font.width(mark.label));
  }
  return *fitting;
}

}  // namespace crampon
