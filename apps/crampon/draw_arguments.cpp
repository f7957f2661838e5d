#include "draw_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "crampon/core/units.hpp"
#include "crampon/picture/draw.hpp"

namespace crampon::app {

namespace fs = std::filesystem;

double number(const std::string& text, const char* option, const std::string& unit) {
  char* end = nullptr;
  const double plain = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && *end == '\0' && std::isfinite(plain)) return plain;
  try {
    return parse_quantity(text, unit.empty() ? "1" : unit);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{}: {}", option, error.what()));
  }
}

Grid panel_grid(const std::string& text) {
  Grid grid;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &grid.rows, &grid.columns, &rest) != 2 || grid.rows < 1 || grid.columns < 1 || grid.rows > 20 ||
      grid.columns > 20)
    throw UsageError(fmt::format("--panel {}: rows and columns are wanted, such as 2x3 (at most 20x20)", text));
  return grid;
}

void check_options(const DrawArguments& arguments) {
  const bool history = !arguments.history.empty(), profile = !arguments.profile.empty(), picture = !history && !profile;
  struct Option {
    const char* name;
    bool given, has_effect;
    const char* instead;
  };
  const char* of_particles = "it shows particles: leave out --history, or this";
  const char* of_pictures = "it is for pictures of particles";
  const Option options[] = {
      {"--quantity", !arguments.quantity.empty(), !history, "name columns after --history"},
      {"--frame", !arguments.frames.empty(), !history, of_particles},
      {"--time", !arguments.times.empty(), !history, "the ends of the time axis are set by --window"},
      {"--all", arguments.all, !history, of_particles},
      {"--panel", !arguments.panel.empty(), picture,
       profile ? "several frames are curves of one plot: --frame, --time or --all" : of_pictures},
      {"--magnify", arguments.magnify != 1, picture, of_pictures},
      {"--range", !arguments.range.empty(), picture, "the ends of the axes are set by --window"},
      {"--symmetric", arguments.symmetric, picture, of_pictures},
      {"--tip-names", arguments.tip_names, picture, of_pictures},
      {"--palette", !arguments.palette.empty(), picture, of_pictures},
      {"--fringes", arguments.fringes, !history, of_particles},
      {"--fringe-constant", arguments.fringe_constant.has_value(), !history && coloured_by(arguments) == "fringes",
       "it goes with --fringes"},
      {"--compare", !arguments.compare.empty(), history, "only plots of --history compare runs"},
  };
  const char* kind = history ? "a plot of histories" : profile ? "a profile" : "a picture";
  for (const Option& option : options) {
    if (option.given && !option.has_effect) throw UsageError(fmt::format("{} has no effect on {}; {}", option.name, kind, option.instead));
  }
  if (arguments.fringes && !arguments.quantity.empty())
    throw UsageError("--fringes and --quantity are both given; each says what to colour by");
}

std::vector<std::size_t> choose_frames(const DrawArguments& arguments, const std::vector<PvdEntry>& frames) {
  const auto count = static_cast<std::ptrdiff_t>(frames.size());
  std::vector<std::size_t> chosen;
  for (const int wanted : arguments.frames) {
    const std::ptrdiff_t index = wanted < 0 ? count + wanted : wanted;
    if (index < 0 || index >= count) throw UsageError(fmt::format("--frame {}: there are {} frames, numbered from 0", wanted, count));
    chosen.push_back(static_cast<std::size_t>(index));
  }
  for (const std::string& text : arguments.times) {
    const double wanted = number(text, "--time", "s");
    const auto nearest = std::min_element(frames.begin(), frames.end(), [wanted](const PvdEntry& a, const PvdEntry& b) {
      return std::abs(a.time - wanted) < std::abs(b.time - wanted);
    });
    chosen.push_back(static_cast<std::size_t>(nearest - frames.begin()));
  }
  if (arguments.all)
    for (std::size_t i = 0; i < frames.size(); ++i) chosen.push_back(i);
  if (!chosen.empty()) {
    if (arguments.panel.empty()) return chosen;
    const Grid panel = panel_grid(arguments.panel);
    if (chosen.size() > static_cast<std::size_t>(panel.rows) * static_cast<std::size_t>(panel.columns))
      throw UsageError(fmt::format("--panel {}: there is no room for {} frames; ask for more rows or columns, or for fewer frames",
                                   arguments.panel, chosen.size()));
    return chosen;
  }
  if (arguments.panel.empty()) return {frames.size() - 1};
  const Grid grid = panel_grid(arguments.panel);
  const auto places = std::min<std::size_t>(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns), frames.size());
  for (std::size_t k = 0; k < places; ++k)  // evenly spread, the last frame always
    chosen.push_back(places == 1 ? frames.size() - 1 : (k * (frames.size() - 1) + (places - 1) / 2) / (places - 1));
  return chosen;
}

std::optional<std::array<double, 4>> window_of(const DrawArguments& arguments, const std::string& x_unit, const std::string& y_unit) {
  if (arguments.window.size() != 4) return std::nullopt;
  std::array<double, 4> window{};
  for (std::size_t k = 0; k < 4; ++k) window[k] = number(arguments.window[k], "--window", k < 2 ? x_unit : y_unit);
  if (!(window[0] < window[1] && window[2] < window[3])) throw UsageError("--window: X0 < X1 and Y0 < Y1 are wanted");
  return window;
}

std::string coloured_by(const DrawArguments& arguments) {
  if (arguments.fringes) return "fringes";
  return arguments.quantity.empty() ? DrawOptions().quantity : arguments.quantity;
}

fs::path picture_file(const DrawArguments& arguments, const ResultsFolder& folder, const std::string& name) {
  const fs::path given(arguments.output);
  fs::path file = given.extension() == ".png" ? given : (given.empty() ? folder.path() / "pictures" : given) / name;
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  return file;
}

void made(const fs::path& file) { fmt::print("{}\n", file.string()); }

}  // namespace crampon::app
