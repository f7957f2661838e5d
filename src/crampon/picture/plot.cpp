#include "crampon/picture/plot.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/picture/axis.hpp"
#include "crampon/picture/canvas.hpp"
#include "crampon/picture/display_scale.hpp"

namespace crampon {
namespace {

constexpr Colour ink{0.1, 0.1, 0.12}, grid_colour{0.88, 0.88, 0.89};

struct Range {
  double lowest = INFINITY, highest = -INFINITY;
  void include(double v) {
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  }
};

// One area: its curves with their place in the legend, which fixes colour and dashes.
struct Area {
  std::vector<std::pair<std::size_t, const Curve*>> curves;
  std::string name, unit;
  Range y;
  Axis axis;
};

void set_dashes(cairo_t* c, std::size_t index, double size) {
  static const std::vector<std::vector<double>> patterns{{}, {}, {0.9, 0.35}, {0.9, 0.3, 0.15, 0.3}, {0.2, 0.3}};
  std::vector<double> dashes = patterns[index % patterns.size()];
  for (double& d : dashes) d *= size;
  cairo_set_dash(c, dashes.data(), static_cast<int>(dashes.size()), 0);
}

void set_style(Canvas& canvas, std::size_t index, double text) {
  canvas.set_colour(curve_colours()[index % curve_colours().size()]);
  set_dashes(canvas.context(), index, text);
  cairo_set_line_width(canvas.context(), std::max(1.5, 0.13 * text));
  cairo_set_line_join(canvas.context(), CAIRO_LINE_JOIN_ROUND);
}

void mark(Canvas& canvas, double x, double y, std::size_t index, double text) {
  cairo_t* c = canvas.context();
  set_dashes(c, 0, text);
  cairo_new_sub_path(c);
  cairo_arc(c, x, y, 0.22 * text, 0, 2 * std::numbers::pi);
  canvas.set_colour({1, 1, 1});
  cairo_fill_preserve(c);
  canvas.set_colour(curve_colours()[index % curve_colours().size()]);
  cairo_set_line_width(c, std::max(1.2, 0.1 * text));
  cairo_stroke(c);
}

void paint_curve(Canvas& canvas, const Curve& curve, std::size_t index, const PlotMap::Area& area, double text) {
  cairo_t* c = canvas.context();
  bool down = false;
  set_style(canvas, index, text);
  const auto is_there = [&](std::size_t i) { return i < curve.x.size() && std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]); };
  std::vector<std::array<double, 2>> alone;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!is_there(i)) {
      down = false;
      continue;
    }
    const auto at = area.pixel(curve.x[i], curve.y[i]);
    if (curve.style == CurveStyle::marks)
      mark(canvas, at[0], at[1], index, text);
    else if (down)
      cairo_line_to(c, at[0], at[1]);
    else if (is_there(i + 1))
      cairo_move_to(c, at[0], at[1]);
    else
      alone.push_back(at);
    down = true;
  }
  cairo_stroke(c);
  for (const auto& at : alone) {
    cairo_arc(c, at[0], at[1], 0.13 * text, 0, 2 * std::numbers::pi);
    cairo_fill(c);
  }
  set_dashes(c, 0, text);
}

// Entries from left to right, wrapped; returns the height used. With Pass::measure nothing is painted.
enum class Pass { measure, paint };
double legend(Canvas& canvas, const std::vector<Area>& areas, double left, double top, double width, double text, Pass pass) {
  const double sample = 2.4 * text, row = 1.6 * text;
  double x = left, y = top;
  const auto speaks_for_itself = [&](const Area& area) {
    return area.curves.size() == 1 && (areas.size() == 1 || area.curves[0].second->label == area.name);
  };
  if (std::all_of(areas.begin(), areas.end(), speaks_for_itself)) return 0;
  for (const Area& area : areas) {
    for (const auto& [index, curve] : area.curves) {
      const std::string label = canvas.shortened(curve->label, text, width - sample - 0.5 * text);
      const double needed = sample + 0.5 * text + canvas.text_width(label, text);
      if (x > left && x + needed > left + width) {
        x = left;
        y += row;
      }
      if (pass == Pass::paint) {
        if (curve->style == CurveStyle::marks) {
          mark(canvas, x + sample / 2, y + row / 2, index, text);
        } else {
          set_style(canvas, index, text);
          cairo_move_to(canvas.context(), x, y + row / 2);
          cairo_line_to(canvas.context(), x + sample, y + row / 2);
          cairo_stroke(canvas.context());
          set_dashes(canvas.context(), 0, text);
        }
        canvas.set_colour(ink);
        canvas.text(x + sample + 0.5 * text, y + row / 2, label, text, AlignX::left, AlignY::middle);
      }
      x += needed + 1.6 * text;
    }
  }
  return y + row - top;
}

// Room around the points; a curve that is flat to round-off gets a range that shows it as flat.
Range fitted(Range r, const std::optional<double>& lowest, const std::optional<double>& highest, double margin) {
  const double largest = std::max(std::abs(r.lowest), std::abs(r.highest));
  double span = r.highest - r.lowest;
  if (span <= 1e-9 * largest || span == 0) {
    const double half = largest > 0 ? 0.05 * largest : 1;
    r = {r.lowest - half, r.highest + half};
    span = 0;
  }
  r = {lowest.value_or(r.lowest - margin * span), highest.value_or(r.highest + margin * span)};
  if (!(r.highest > r.lowest)) throw std::invalid_argument("the range to plot is empty");
  return r;
}

// Only the lowest of several areas numbers the shared axis.
enum class AxisNumbers { shown, hidden };

void paint_area(Canvas& canvas, const Area& area, const PlotMap::Area& map, const Axis& x_axis, double text, AxisNumbers numbers) {
  const double tick = 0.35 * text, bottom = map.top + map.height;
  for (const Axis::Mark& mark : x_axis.marks) {
    const double x = map.pixel(mark.value, 0)[0];
    canvas.set_colour(grid_colour);
    canvas.line(x, map.top, x, bottom, 1);
    canvas.set_colour(ink);
    canvas.line(x, bottom, x, bottom + tick, 1);
    if (numbers == AxisNumbers::shown) canvas.text(x, bottom + tick + 0.1 * text, mark.label, text, AlignX::centre, AlignY::top);
  }
  for (const Axis::Mark& mark : area.axis.marks) {
    const double y = map.pixel(0, mark.value)[1];
    canvas.set_colour(grid_colour);
    canvas.line(map.left, y, map.left + map.width, y, 1);
    canvas.set_colour(ink);
    canvas.line(map.left - tick, y, map.left, y, 1);
    canvas.text(map.left - tick - 0.3 * text, y, mark.label, text, AlignX::right, AlignY::middle);
  }
  canvas.stroke_box({map.left - 0.5, map.top - 0.5, map.width + 1, map.height + 1}, 1);
  for (const auto& [index, curve] : area.curves) {
    const double over = (curve->style == CurveStyle::marks ? 0.3 : 0.1) * text;  // a mark or a line on the edge is shown whole
    cairo_save(canvas.context());
    cairo_rectangle(canvas.context(), map.left - over, map.top - over, map.width + 2 * over, map.height + 2 * over);
    cairo_clip(canvas.context());
    paint_curve(canvas, *curve, index, map, text);
    cairo_restore(canvas.context());
  }
  canvas.set_colour(ink);
  const double fitting = canvas.fitting_size(area.axis.title, text, map.height);
  canvas.text_upwards(0.5 * text + 0.75 * text, map.top + map.height / 2, area.axis.title, fitting);
}

// Of what is measured in a unit.
std::string quantity_of_unit(const std::string& unit) {
  static const std::map<std::string, std::string> all{
      {"J", "energy"},        {"N", "force"},    {"Pa", "stress"}, {"m", "length"}, {"s", "time"},    {"m/s", "velocity"},
      {"kg m/s", "momentum"}, {"N m", "moment"}, {"kg", "mass"},   {"W", "power"},  {"rad", "angle"}, {"J/m2", "energy per area"},
      {"Pa m^(1/2)", "K"}};
  const auto found = all.find(unit);
  return found == all.end() ? "" : found->second;
}

PlotMap plot_areas(std::vector<Area> areas, const PlotOptions& options, const std::filesystem::path& path) {
  Range x;
  for (Area& area : areas) {
    for (const auto& [index, curve] : area.curves) {
      if (curve->x.size() != curve->y.size())
        throw std::invalid_argument(fmt::format("curve \"{}\": x and y differ in length", curve->label));
      for (std::size_t i = 0; i < curve->x.size(); ++i) {
        if (!std::isfinite(curve->x[i]) || !std::isfinite(curve->y[i])) continue;
        if (curve->x[i] < options.x_lowest.value_or(-INFINITY) || curve->x[i] > options.x_highest.value_or(INFINITY)) continue;
        x.include(curve->x[i]);
        area.y.include(curve->y[i]);
      }
    }
    if (area.y.highest < area.y.lowest) throw std::invalid_argument(fmt::format("there is nothing to plot of {}", area.name));
  }
  x = fitted(x, options.x_lowest, options.x_highest, 0);

  const double text = std::clamp(options.width / 65., 11., 40.), tick = 0.35 * text;
  const double title_height = options.title.empty() ? 0 : 2.2 * text;
  const double bottom = tick + 3.4 * text, right = 1.6 * text, between = 0.9 * text;
  const auto count = static_cast<double>(areas.size());
  double left = 6 * text, legend_height = 0, height = 0;
  int low = options.height;  // of the picture, which grows where its areas would be too low for numbers
  Canvas ruler(1, 1);
  const LabelFont font = label_font(ruler, text);
  for (int round = 0; round < 3; ++round) {
    legend_height = legend(ruler, areas, left, 0, options.width - left - right, text, Pass::measure);
    const double other = 0.8 * text + title_height + legend_height + bottom + (count - 1) * between, least = 5 * text;
    low = std::max(options.height, static_cast<int>(std::ceil(other + count * least)));
    height = std::floor((low - other) / count);
    double widest_label = 0;
    for (Area& area : areas) {
      const Range y = fitted(area.y, options.y_lowest, options.y_highest, 0.06);
      const auto labelled = [&] {
        return label_axis({y.lowest, y.highest, area.name, area.unit, {}}, Direction::upwards, height, 0.5 * text, font);
      };
      area.axis = labelled();
      if (const std::string shorter = quantity_of_unit(area.unit); font.width(area.axis.title) > height && !shorter.empty()) {
        area.name = shorter;  // the legend names the curves then
        area.axis = labelled();
      }
      widest_label = std::max(widest_label, area.axis.width);
    }
    left = std::floor(2.5 * text + widest_label + 0.3 * text + tick);
  }
  const double width = std::max(8 * text, std::floor(options.width - left - right));
  const double top = std::floor(0.8 * text + title_height + legend_height);
  const int wide = std::max(options.width, static_cast<int>(std::ceil(left + width + right)));
  const Axis x_axis = label_axis({x.lowest, x.highest, options.x_name, options.x_unit, {}}, Direction::across, width, right, font);

  Canvas canvas(wide, low);
  PlotMap map{wide, low, {}, {}};
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Range y = fitted(areas[i].y, options.y_lowest, options.y_highest, 0.06);
    map.areas.push_back(
        {left, std::floor(top + static_cast<double>(i) * (height + between)), width, height, x.lowest, x.highest, y.lowest, y.highest});
    paint_area(canvas, areas[i], map.areas.back(), x_axis, text, i + 1 == areas.size() ? AxisNumbers::shown : AxisNumbers::hidden);
  }
  const PlotMap::Area& last = map.areas.back();
  canvas.text(left + width / 2, last.top + last.height + tick + 1.6 * text, x_axis.title, canvas.fitting_size(x_axis.title, text, width),
              AlignX::centre, AlignY::top);
  if (!options.title.empty()) {
    const double fitting = std::max(canvas.fitting_size(options.title, 1.2 * text, wide - text), 0.7 * text);
    canvas.text(wide / 2., 0.5 * text + title_height / 2, canvas.shortened(options.title, fitting, wide - text), fitting, AlignX::centre,
                AlignY::middle);
  }
  legend(canvas, areas, left, 0.4 * text + title_height, width, text, Pass::paint);
  map.texts = canvas.texts();
  canvas.save(path);
  return map;
}

// What curves of one unit have in common: the quantity where they differ in the thing alone, else the last words of their names, else what is measured in
// that unit, else all names.
std::string common_name(const std::vector<std::string>& names, const std::string& unit) {
  const std::string of_first = names[0].substr(0, names[0].find(", "));
  if (of_first != names[0] && std::all_of(names.begin(), names.end(), [&](const std::string& n) { return n.starts_with(of_first + ", "); }))
    return of_first;
  const auto last_words = [&](std::size_t length) { return names[0].substr(names[0].size() - length); };
  std::string common;
  for (std::size_t from = names[0].find(' '); from != std::string::npos && common.empty(); from = names[0].find(' ', from + 1)) {
    const std::string end = last_words(names[0].size() - from);
    const auto ends_so = [&](const std::string& n) {
      return n.find(", ") == std::string::npos && (n.ends_with(end) || n == end.substr(1));
    };
    if (std::all_of(names.begin(), names.end(), ends_so)) common = end.substr(1);
  }
  if (common.empty()) common = quantity_of_unit(unit);
  if (!common.empty()) return common;
  for (const std::string& name : names) common += (common.empty() ? "" : ", ") + name;
  return common;
}

// Each name once, in the order in which they come.
std::vector<std::string> different(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names)
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  return all;
}

}  // namespace

PlotMap plot_profiles(const std::vector<Curve>& curves, const PlotOptions& options, const std::filesystem::path& path) {
  Area area;
  area.name = options.y_name;
  area.unit = options.y_unit;
  for (std::size_t i = 0; i < curves.size(); ++i) area.curves.emplace_back(i, &curves[i]);
  return plot_areas({std::move(area)}, options, path);
}

PlotMap plot_history(const std::vector<HistoryCurve>& curves, const PlotOptions& options, const std::filesystem::path& path) {
  std::vector<Curve> drawn;
  std::vector<std::string> names, units;
  for (const HistoryCurve& c : curves) {
    const std::string name = spelt_out(c.column);
    const std::string along = c.over.empty() ? c.history->columns.at(0).name : c.over;
    drawn.push_back({c.label.empty() ? name : c.label, c.history->column(along), c.history->column(c.column), CurveStyle::line});
    names.push_back(name);
    units.push_back(c.history->unit(c.column));
  }
  std::vector<Area> areas;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    auto area = std::find_if(areas.begin(), areas.end(), [&](const Area& a) { return a.unit == units[i]; });
    if (area == areas.end()) {
      area = areas.insert(areas.end(), Area{});
      area->unit = units[i];
      area->name = names[i];
    }
    area->curves.emplace_back(i, &drawn[i]);
  }
  for (Area& area : areas) {
    std::vector<std::string> shown;
    for (const auto& [index, curve] : area.curves) shown.push_back(names[index]);
    shown = different(shown);
    if (shown.size() > 1) area.name = common_name(shown, area.unit);
  }
  if (areas.empty()) throw std::invalid_argument("there is nothing to plot: no column");
  PlotOptions filled = options;
  const std::string& along = curves[0].over;
  if (filled.x_unit.empty()) filled.x_unit = along.empty() ? "s" : curves[0].history->unit(along);
  std::vector<std::string> over;
  for (const HistoryCurve& c : curves) {
    over.push_back(c.over.empty() ? "time" : spelt_out(c.over));
    if (const std::string unit = c.over.empty() ? "s" : c.history->unit(c.over); unit != filled.x_unit)
      throw std::invalid_argument(fmt::format("curves over a column in {} and over one in {} have no axis in common", filled.x_unit, unit));
  }
  over = different(over);
  if (filled.x_name.empty()) filled.x_name = over.size() > 1 ? common_name(over, filled.x_unit) : over[0];
  if (areas.size() == 1 && !options.y_name.empty()) areas[0].name = options.y_name;
  return plot_areas(std::move(areas), filled, path);
}

PlotMap plot_history(const History& history, const std::vector<std::string>& columns, const PlotOptions& options,
                     const std::filesystem::path& path) {
  std::vector<HistoryCurve> curves;
  for (const std::string& column : columns) curves.push_back({&history, column, ""});
  return plot_history(curves, options, path);
}

}  // namespace crampon
