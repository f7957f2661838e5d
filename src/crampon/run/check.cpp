#include "crampon/run/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/core/units.hpp"
#include "crampon/output/history.hpp"
#include "crampon/output/quantity.hpp"
#include "crampon/output/run_record.hpp"

namespace crampon {
namespace {

using Statistic = ExpectInput::Statistic;

/// Results of a run as its expectations see them; files are read when first needed.
class Results {
 public:
  explicit Results(const ResultsFolder& folder) : folder_(folder) {
    if (!std::filesystem::exists(folder.run_record())) return;
    complete_ = read_run_record(folder.run_record()).status == "finished";
  }

  /// Did the run come to its end? Only then "the last record" and "all records" are what an entry means.
  bool complete() const { return complete_; }

  const History& history() {
    if (!history_) history_ = read_history(folder_.history());
    return *history_;
  }

  const std::vector<PvdEntry>& frames() {
    if (!frames_) frames_ = folder_.particle_frames();
    if (frames_->empty()) throw std::runtime_error(fmt::format("{}: no particle frames", folder_.path().string()));
    return *frames_;
  }
  const PointFrame& particles(const PvdEntry& entry) {
    if (loaded_ != entry.file) {  // expectations mostly ask for one and the same frame
      frame_ = folder_.read_particles(entry);
      loaded_ = entry.file;
    }
    return frame_;
  }

 private:
  const ResultsFolder& folder_;
  bool complete_ = false;
  std::optional<History> history_;
  std::optional<std::vector<PvdEntry>> frames_;
  std::string loaded_;
  PointFrame frame_;
};

struct Measured {
  std::optional<double> value;  ///< SI; empty: the results do not reach that far
  std::string unit;             ///< SI
};

double statistic_of(const HistoryStatistics& all, Statistic statistic) {
  switch (statistic) {
    case Statistic::minimum:
      return all.minimum;
    case Statistic::maximum:
      return all.maximum;
    case Statistic::mean:
      return all.mean;
    default:
      return all.spread;
  }
}

/// The time at which the records end serves as reached when it misses the wanted one by round-off.
bool reaches(double last, double wanted) { return wanted <= last + 1e-9 * std::abs(last); }

Measured measure_history(const History& history, const std::string& column, const ExpectInput& expect, bool complete) {
  const std::vector<double>& times = history.values[0];
  Measured out{.value = {}, .unit = history.unit(column)};
  if (times.empty()) return out;
  if (expect.statistic == Statistic::value) {
    if (expect.time) {
      if (reaches(times.back(), *expect.time)) out.value = history.value_at(column, std::min(*expect.time, times.back()));
    } else if (complete) {
      out.value = history.column(column).back();
    }
  } else if (expect.range.size() == 2) {
    if (reaches(times.back(), expect.range[1]))
      out.value = statistic_of(history.statistics(column, expect.range[0], std::min(expect.range[1], times.back())), expect.statistic);
  } else if (complete) {
    out.value = statistic_of(history.statistics(column, times.front(), times.back()), expect.statistic);
  }
  return out;
}

std::size_t nearest_particle(const PointFrame& frame, const std::vector<double>& point) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; 3 * i + 2 < frame.positions.size(); ++i) {
    double distance = 0;
    for (std::size_t k = 0; k < std::min<std::size_t>(point.size(), 3); ++k)
      distance += (frame.positions[3 * i + k] - point[k]) * (frame.positions[3 * i + k] - point[k]);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

Measured measure_particles(Results& results, const ExpectInput& expect) {
  const std::vector<PvdEntry>& frames = results.frames();
  if (expect.time ? !reaches(frames.back().time, *expect.time) : !results.complete()) return {};
  const double wanted = expect.time.value_or(frames.back().time);
  const auto nearest = std::min_element(frames.begin(), frames.end(), [wanted](const PvdEntry& a, const PvdEntry& b) {
    return std::abs(a.time - wanted) < std::abs(b.time - wanted);
  });
  const PointFrame& frame = results.particles(*nearest);
  const PointValues all = evaluate_quantity(frame, *expect.quantity);
  if (all.values.empty()) throw std::invalid_argument("the frame holds no particles");
  return {all.values[nearest_particle(frame, expect.point)], all.unit};
}

std::string figure_text(const ExpectInput& expect) {
  std::string text;
  switch (expect.statistic) {
    case Statistic::value:
      break;
    case Statistic::minimum:
      text = "minimum of ";
      break;
    case Statistic::maximum:
      text = "maximum of ";
      break;
    case Statistic::mean:
      text = "mean of ";
      break;
    case Statistic::spread:
      text = "spread of ";
      break;
  }
  text += expect.column ? *expect.column : expect.quantity.value_or("");
  if (!expect.point.empty()) text += fmt::format(" at ({:g})", fmt::join(expect.point, ", "));
  if (expect.statistic == Statistic::value)
    text += expect.time ? fmt::format(", {:g} s", *expect.time) : ", at the end";
  else if (expect.range.size() == 2)
    text += fmt::format(", {:g} s to {:g} s", expect.range[0], expect.range[1]);
  return text;
}

CheckRow check_one(Results& results, const ExpectInput& expect) {
  const Measured measured =
      expect.column ? measure_history(results.history(), *expect.column, expect, results.complete()) : measure_particles(results, expect);
  double tolerance = expect.tolerance;
  if (expect.relative) tolerance = std::max(tolerance, *expect.relative * std::abs(expect.value));

  CheckRow row;
  row.name = expect.name.empty() ? expect.column.value_or(expect.quantity.value_or("")) : expect.name;
  row.figure = figure_text(expect);
  row.unit = measured.unit;
  row.source = expect.source;
  double factor = 1;
  if (!expect.unit.empty()) {
    factor = measured.unit.empty() ? 1 : unit_factor(expect.unit, measured.unit);
    row.unit = expect.unit;
  }
  row.expected = expect.value / factor;
  row.tolerance = tolerance / factor;
  row.measured = measured.value ? *measured.value / factor : std::numeric_limits<double>::quiet_NaN();
  if (!measured.value)
    row.verdict = Verdict::not_reached;
  else
    row.verdict = std::abs(*measured.value - expect.value) <= tolerance ? Verdict::met : Verdict::missed;
  return row;
}

}  // namespace

std::vector<CheckRow> check_results(const ResultsFolder& folder, const Problem& problem) {
  Results results(folder);
  std::vector<CheckRow> rows;
  for (const ExpectInput& expect : problem.expects) try {
      rows.push_back(check_one(results, expect));
    } catch (const std::logic_error& error) {  // names and units that these results do not know
      throw std::runtime_error(fmt::format("{}: {}: {}", folder.path().string(), expect.location.where, error.what()));
    }
  return rows;
}

std::string check_table(const std::vector<CheckRow>& rows) {
  const auto number = [](double x) { return std::isnan(x) ? std::string("-") : fmt::format("{:.6g}", x); };
  std::vector<std::vector<std::string>> cells{{"verdict", "name", "measured", "expected", "tolerance", "unit", "what", "source"}};
  for (const CheckRow& row : rows) {
    const char* verdict = row.verdict == Verdict::met ? "met" : row.verdict == Verdict::missed ? "MISSED" : "NOT REACHED";
    cells.push_back(
        {verdict, row.name, number(row.measured), number(row.expected), number(row.tolerance), row.unit, row.figure, row.source});
  }
  std::string text;
  for (const std::vector<std::string>& line : cells) {
    std::string out;
    for (std::size_t k = 0; k < line.size(); ++k) {
      std::size_t width = 0;
      for (const std::vector<std::string>& other : cells) width = std::max(width, other[k].size());
      const bool numeric = k >= 2 && k <= 4;
      out += numeric ? fmt::format("{:>{}}  ", line[k], width) : fmt::format("{:<{}}  ", line[k], width);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    text += out + "\n";
  }
  return text;
}

}  // namespace crampon
