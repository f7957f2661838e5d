#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <filesystem>

#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/output/crack_tips.hpp"
#include "crampon/output/results_folder.hpp"
#include "crampon/output/run_record.hpp"
#include "crampon/picture/draw.hpp"
#include "draw_arguments.hpp"
#include "draw_moments.hpp"
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
  options.tip_names = arguments.tip_names;
  options.title = title;
  options.width = arguments.width;
  if (!arguments.panel.empty()) options.columns = panel_grid(arguments.panel).columns;
  return options;
}

/// What the picture cannot show of the rigid bodies and walls.
void tell_what_is_not_drawn(const Moments& moments, const Moment& moment) {
  if (!moments.problem()) return;
  const Problem& problem = *moments.problem();
  if (moment.rigid.empty() && problem.rigids.size() + problem.walls.size() > 0)
    tell("these results do not tell where walls and rigid bodies are; walls are not drawn, and rigid bodies by their particles");
  for (const RigidShape& rigid : moment.rigid) {
    if (!RigidView(rigid, 1, 0).shows_an_edge())
      tell(fmt::format("the wall \"{}\" is not drawn: pictures look along z, straight at its face", rigid.name));
  }
}

/// Names of what the quantity's numbers stand for, where the frame does not tell them: materials, by the bodies that are made of them.
std::vector<std::string> category_names(const Moments& moments, const PointFrame& frame, const std::string& quantity) {
  std::vector<std::string> names;
  if (quantity != "material" || !moments.problem()) return names;
  const std::vector<BodyInput>& bodies = moments.problem()->bodies;
  const std::vector<double> body = evaluate_quantity(frame, "body").values, material = evaluate_quantity(frame, quantity).values;
  for (std::size_t p = 0; p < material.size(); ++p) {
    const auto number = static_cast<std::size_t>(material[p]), of = static_cast<std::size_t>(body[p]);
    if (number >= names.size()) names.resize(number + 1);
    names[number] = of < bodies.size() ? bodies[of].material : "rigid";
  }
  return names;
}

/// A category has no range, and no palette.
void check_colour_options(const DrawArguments& arguments) {
  for (const auto& [name, given] :
       {std::pair{"--range", !arguments.range.empty()}, {"--symmetric", arguments.symmetric}, {"--palette", !arguments.palette.empty()}}) {
    if (given)
      throw UsageError(
          fmt::format("{} has no effect on \"{}\": its numbers are names, each of which has a colour", name, arguments.quantity));
  }
}

std::optional<std::array<double, 4>> grid_window(const std::optional<Problem>& problem) {
  if (!problem || problem->grid.origin.size() < 2 || problem->grid.size.size() < 2) return std::nullopt;
  const std::vector<double>&low = problem->grid.origin, &size = problem->grid.size;
  return std::array<double, 4>{low[0], low[0] + size[0], low[1], low[1] + size[1]};
}

/// One window and one colour range for a whole series, so that its pictures can be compared: found frame by frame, as all of them may not
/// fit in memory.
PictureExtent common_extent(const Moments& moments, const std::vector<std::size_t>& chosen, const DrawOptions& options) {
  PictureExtent extent;
  for (const std::size_t i : chosen) {
    const Moment moment = moments.read(i);
    extent.include(picture_extent(moment.snapshot(), options));
  }
  return extent;
}

void draw_pictures(const DrawArguments& arguments, const ResultsFolder& folder, const std::string& title) {
  const Moments moments(folder);
  if (moments.frames().empty()) throw UsageError(fmt::format("{}: there are no frames to draw", folder.path().string()));
  const std::vector<std::size_t> chosen = choose_frames(arguments, moments.frames());
  if (chosen.size() > 1 && arguments.panel.empty() && fs::path(arguments.output).extension() == ".png")
    throw UsageError(fmt::format("--output {}: a file is named for {} pictures; name a folder, or put them into one picture by --panel",
                                 arguments.output, chosen.size()));
  const Moment first = moments.read(chosen.front());
  const std::string unit = evaluate_quantity(first.particles, coloured_by(arguments)).unit;
  if (is_category(first.particles, coloured_by(arguments))) check_colour_options(arguments);
  DrawOptions options = picture_options(arguments, title, unit.empty() ? "1" : unit);
  options.grid = grid_window(moments.problem());
  options.category_names = category_names(moments, first.particles, options.quantity);
  tell_what_is_not_drawn(moments, first);
  if (arguments.tip_names && (!first.cracks || tips_of(*first.cracks).empty()))
    throw UsageError(
        "--tip-names: these results tell of no tips; they do where the input has [fracture] and an end of a crack lies in a body");

  if (!arguments.panel.empty()) {
    std::deque<Moment> in_memory;
    std::vector<Snapshot> snapshots;
    for (const std::size_t i : chosen) snapshots.push_back(in_memory.emplace_back(moments.read(i)).snapshot());
    const fs::path file = picture_file(arguments, folder, options.quantity + "_panel.png");
    draw_panel(snapshots, options, file);
    made(file);
    return;
  }
  if (chosen.size() > 1) options.extent = common_extent(moments, chosen, options);
  for (const std::size_t i : chosen) {
    const fs::path file = picture_file(arguments, folder, fmt::format("{}_{:06}.png", options.quantity, i));
    const Moment moment = moments.read(i);
    draw_frame(moment.snapshot(), options, file);
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
