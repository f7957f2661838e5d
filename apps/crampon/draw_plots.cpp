#include "draw_plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "crampon/core/formula.hpp"
#include "crampon/core/units.hpp"
#include "crampon/output/quantity.hpp"
#include "crampon/picture/display_scale.hpp"
#include "crampon/picture/plot.hpp"
#include "draw_arguments.hpp"
#include "draw_moments.hpp"

namespace crampon::app {
namespace {

namespace fs = std::filesystem;

/// "name [unit] = formula" in its parts; a text without "=" is a name alone.
struct NamedFormula {
  std::string name, unit, formula;
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

NamedFormula named_formula(const std::string& text, const char* option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return {trimmed(text), "", ""};
  NamedFormula parts{trimmed(text.substr(0, equals)), "", trimmed(text.substr(equals + 1))};
  const std::size_t bracket = parts.name.find('[');
  if (bracket != std::string::npos && parts.name.back() == ']') {
    parts.unit = trimmed(parts.name.substr(bracket + 1, parts.name.size() - bracket - 2));
    parts.name = trimmed(parts.name.substr(0, bracket));
  }
  if (parts.name.empty()) throw UsageError(fmt::format("{} \"{}\": there is no name before \"=\"", option, text));
  if (!parts.unit.empty() && unit_factor(parts.unit, "any") != 1)
    throw UsageError(fmt::format("{} \"{}\": formulas are in SI, and so is their unit; \"{}\" is not", option, text, parts.unit));
  return parts;
}

/// The columns that an option names: one, all of a quantity, or a new one where it is a formula.
std::vector<std::string> columns_of(History& history, const std::string& text, const char* option) {
  const NamedFormula parts = named_formula(text, option);
  if (parts.formula.empty()) return history.columns_of(parts.name);
  history.add_column({parts.name, parts.unit}, parts.formula);
  return {parts.name};
}

/// Of the columns that --against names, the one for a column: of several, that of the same thing, as "crack_length.notch" for "J.notch.end".
std::string abscissa_of(const std::string& column, const std::vector<std::string>& against) {
  if (against.size() <= 1) return against.empty() ? "" : against[0];
  const auto thing = [](const std::string& name) { return name.find('.') == std::string::npos ? "" : name.substr(name.find('.')) + "."; };
  std::string found;
  for (const std::string& along : against) {
    if (thing(along) == thing(column)) return along;
    if (thing(column).starts_with(thing(along))) found = along;
  }
  if (found.empty())
    throw UsageError(fmt::format("--against: \"{}\" belongs to none of {}; name one of them", column, fmt::join(against, ", ")));
  return found;
}

PlotOptions plot_options(const DrawArguments& arguments, const std::string& title) {
  PlotOptions options;
  options.title = title;
  options.width = arguments.width;
  options.height = arguments.width * 3 / 5;
  return options;
}

/// Particles whose mean is one mark.
struct Strip {
  double x = 0, value = 0;
  int count = 0;
  void add(double x_of, double value_of) { x += x_of, value += value_of, ++count; }
};

}  // namespace

void draw_history(const DrawArguments& arguments, const ResultsFolder& folder, const std::string& title) {
  PlotOptions options = plot_options(arguments, title);
  std::vector<fs::path> folders = {folder.path()};
  folders.insert(folders.end(), arguments.compare.begin(), arguments.compare.end());
  std::vector<History> histories;
  for (const fs::path& path : folders) histories.push_back(read_history(ResultsFolder::open(path).history()));
  std::vector<HistoryCurve> curves;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    std::vector<std::string> against, columns;
    if (!arguments.against.empty()) against = columns_of(histories[i], arguments.against, "--against");
    for (const std::string& text : arguments.history)
      for (std::string& column : columns_of(histories[i], text, "--history")) columns.push_back(std::move(column));
    const std::string run = (folders[i].has_filename() ? folders[i] : folders[i].parent_path()).stem().string();
    for (const std::string& column : columns) {
      const std::string label = folders.size() == 1 ? "" : columns.size() == 1 ? run : run + ", " + column;
      curves.push_back({&histories[i], column, label, abscissa_of(column, against)});
    }
  }
  const std::string x_unit = curves[0].over.empty() ? "s" : histories[0].unit(curves[0].over);
  if (const auto window = window_of(arguments, x_unit, histories[0].unit(curves[0].column))) {
    options.x_lowest = (*window)[0], options.x_highest = (*window)[1];
    options.y_lowest = (*window)[2], options.y_highest = (*window)[3];
  }
  const fs::path file = picture_file(arguments, folder, "history.png");
  plot_history(curves, options, file);
  made(file);
}

void draw_profile(const DrawArguments& arguments, const ResultsFolder& folder, const std::string& title) {
  const Moments moments(folder);
  const std::vector<PvdEntry>& frames = moments.frames();
  if (frames.empty()) throw UsageError(fmt::format("{}: there are no frames to draw", folder.path().string()));
  const std::vector<std::size_t> chosen = choose_frames(arguments, frames);
  const auto axis = static_cast<std::size_t>(arguments.profile[0] - 'x');
  PlotOptions options = plot_options(arguments, title);
  options.x_name = arguments.profile;
  options.x_unit = "m";
  const std::string shown = coloured_by(arguments);
  options.y_name = spelt_out(shown);
  const std::optional<std::array<double, 4>> window = window_of(arguments, "m", "m");

  std::vector<Curve> curves;
  double lowest = INFINITY, highest = -INFINITY, time = 0;
  for (const std::size_t i : chosen) {
    const Moment moment = moments.read(i);
    const PointFrame& frame = moment.particles;
    if (axis >= static_cast<std::size_t>(frame.dimension)) throw UsageError("--profile z: these results are in the plane; choose x or y");
    if (is_category(frame, shown))
      throw UsageError(fmt::format("--profile: the numbers of \"{}\" are names and have no place on an axis; draw a picture of it", shown));
    const PointValues quantity = evaluate_quantity(frame, shown, arguments.fringe_constant.value_or(paper_fringe_constant));
    const std::vector<bool> rigid = moment.of_rigid_bodies();  // they have no stress, and pictures do not colour them either
    Curve& curve = curves.emplace_back();
    curve.label = quantity_text(frame.time, frames[chosen.back()].time, "s");
    curve.style = CurveStyle::marks;
    std::map<double, Strip> strips;
    for (std::size_t p = 0; p < quantity.values.size(); ++p) {
      if (rigid[p]) continue;
      std::array<double, 3> at{};
      frame.positions.copy(3 * p, 3, at.data());
      if (window && !(at[0] >= (*window)[0] && at[0] <= (*window)[1] && at[1] >= (*window)[2] && at[1] <= (*window)[3])) continue;
      lowest = std::min(lowest, at[axis]), highest = std::max(highest, at[axis]);
      strips[arguments.mean && frame.cell > 0 ? std::floor(at[axis] / frame.cell) : static_cast<double>(p)].add(at[axis],
                                                                                                                quantity.values[p]);
    }
    for (const auto& [place, strip] : strips) {
      curve.x.push_back(strip.x / strip.count);
      curve.y.push_back(strip.value / strip.count);
    }
    options.y_unit = quantity.unit;
    time = frame.time;
  }
  for (const std::string& text : arguments.over) {
    const NamedFormula parts = named_formula(text, "--over");
    if (parts.formula.empty()) throw UsageError(fmt::format("--over \"{}\": \"label = formula\" is wanted", text));
    Formula formula(parts.formula, {arguments.profile, "t"});
    Curve& curve = curves.emplace_back();
    curve.label = parts.name;
    constexpr int intervals = 500;
    for (int k = 0; k <= intervals && lowest <= highest; ++k) {
      const double x = lowest + k * (highest - lowest) / intervals;
      curve.x.push_back(x);
      curve.y.push_back(formula(std::array<double, 2>{x, time}));
    }
  }
  const fs::path file = picture_file(arguments, folder, "profile.png");
  plot_profiles(curves, options, file);
  made(file);
}

}  // namespace crampon::app
