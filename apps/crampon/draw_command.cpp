#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <filesystem>

#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/output/draw.hpp"
#include "crampon/output/results_folder.hpp"
#include "crampon/output/run_record.hpp"
#include "draw_arguments.hpp"
#include "draw_plots.hpp"

namespace crampon::app {
namespace {

namespace fs = std::filesystem;

/// Picture or folder to write to: what has an extension is a picture.
void check_picture_name(const DrawArguments& arguments) {
  const fs::path extension = fs::path(arguments.output).extension();
  if (!extension.empty() && extension != ".png")
    throw UsageError(fmt::format("--output {}: pictures are PNG files; name it *.png, or a folder", arguments.output));
}

/// unit: of the quantity drawn.
DrawOptions picture_options(const DrawArguments& arguments, const std::string& title, const std::string& unit) {
  DrawOptions options;
  options.quantity = coloured_by(arguments);
  if (arguments.palette == "uniform") options.palette = Palette::uniform;
  if (arguments.palette == "grey") options.palette = Palette::grey;
  if (arguments.palette == "diverging") options.palette = Palette::diverging;
  if (arguments.symmetric) options.range = ColourRange::symmetric;
  if (arguments.range.size() == 2) {
    options.lowest = number(arguments.range[0], "--range", unit);
    options.highest = number(arguments.range[1], "--range", unit);
    if (!(*options.lowest < *options.highest)) throw UsageError("--range: the first value must be below the second");
  }
  options.window = window_of(arguments, "m", "m");
  options.magnification = arguments.magnify;
  options.fringe_constant = arguments.fringe_constant.value_or(paper_fringe_constant);
  options.title = title;
  options.width = arguments.width;
  if (!arguments.panel.empty()) options.columns = panel_grid(arguments.panel).columns;
  return options;
}

/// A frame with its cracks, in memory.
struct Moment {
  PointFrame particles;
  std::optional<CrackFrame> cracks;
  Snapshot snapshot() const { return {&particles, cracks ? &*cracks : nullptr}; }
};

Moment read_moment(const ResultsFolder& folder, const PvdEntry& entry, const std::vector<PvdEntry>& cracks) {
  Moment moment{folder.read_particles(entry), std::nullopt};
  const auto found = std::find_if(cracks.begin(), cracks.end(), [&entry](const PvdEntry& c) { return c.time == entry.time; });
  if (found != cracks.end()) moment.cracks = folder.read_cracks(*found);
  return moment;
}

/// One colour range for a whole series, so that its pictures can be compared: found frame by frame, as all of them may not fit in memory.
void fix_range(DrawOptions& options, const ResultsFolder& folder, const std::vector<PvdEntry>& frames,
               const std::vector<std::size_t>& chosen) {
  if (chosen.size() < 2 || options.quantity == "fringes" || (options.lowest && options.highest)) return;
  double lowest = INFINITY, highest = -INFINITY;
  for (const std::size_t i : chosen) {
    for (const double value : evaluate_quantity(folder.read_particles(frames[i]), options.quantity, options.fringe_constant).values) {
      if (!std::isfinite(value)) continue;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  if (options.range == ColourRange::symmetric) {
    highest = std::max(std::abs(lowest), std::abs(highest));
    lowest = -highest;
  }
  if (!(lowest < highest)) return;  // one value everywhere: each picture finds a range around it
  if (!options.lowest) options.lowest = lowest;
  if (!options.highest) options.highest = highest;
}

void draw_pictures(const DrawArguments& arguments, const ResultsFolder& folder, const std::string& title) {
  const std::vector<PvdEntry> frames = folder.particle_frames(), cracks = folder.crack_frames();
  if (frames.empty()) throw UsageError(fmt::format("{}: there are no frames to draw", folder.path().string()));
  const std::vector<std::size_t> chosen = choose_frames(arguments, frames);
  if (chosen.size() > 1 && arguments.panel.empty() && fs::path(arguments.output).extension() == ".png")
    throw UsageError(fmt::format("--output {}: a file is named for {} pictures; name a folder, or put them into one picture by --panel",
                                 arguments.output, chosen.size()));
  const std::string unit = evaluate_quantity(folder.read_particles(frames[chosen.front()]), coloured_by(arguments)).unit;
  DrawOptions options = picture_options(arguments, title, unit.empty() ? "1" : unit);

  if (!arguments.panel.empty()) {
    std::deque<Moment> moments;
    std::vector<Snapshot> snapshots;
    snapshots.reserve(chosen.size());
    for (const std::size_t i : chosen) snapshots.push_back(moments.emplace_back(read_moment(folder, frames[i], cracks)).snapshot());
    const fs::path file = picture_file(arguments, folder, options.quantity + "_panel.png");
    draw_panel(snapshots, options, file);
    made(file);
    return;
  }
  fix_range(options, folder, frames, chosen);
  for (const std::size_t i : chosen) {
    const fs::path file = picture_file(arguments, folder, fmt::format("{}_{:06}.png", options.quantity, i));
    const Moment moment = read_moment(folder, frames[i], cracks);
    draw_frame(moment.particles, moment.cracks ? &*moment.cracks : nullptr, options, file);
    made(file);
  }
}

}  // namespace

int draw_command(const DrawArguments& arguments) {
  check_picture_name(arguments);
  check_options(arguments);
  if (!std::isfinite(arguments.magnify)) throw UsageError("--magnify: a finite number is needed");
  if (arguments.fringe_constant && !(*arguments.fringe_constant > 0)) throw UsageError("--fringe-constant: a positive number is needed");
  const ResultsFolder folder = ResultsFolder::open(arguments.results);
  const std::string title = arguments.title.value_or(read_run_record(folder.run_record()).title);
  try {
    if (!arguments.history.empty())
      draw_history(arguments, folder, title);
    else if (!arguments.profile.empty())
      draw_profile(arguments, folder, title);
    else
      draw_pictures(arguments, folder, title);
  } catch (const std::invalid_argument& error) {  // names that these results do not know
    throw UsageError(error.what());
  } catch (const std::out_of_range& error) {
    throw UsageError(error.what());
  }
  return exit_ok;
}

}  // namespace crampon::app
