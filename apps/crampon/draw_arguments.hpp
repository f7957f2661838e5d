#pragma once
/// What the words of `crampon draw` mean, for pictures and plots alike.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "crampon/output/results_folder.hpp"

namespace crampon::app {

/// "5 MPa" in SI; a plain number is SI. Throws UsageError, which names the option.
double number(const std::string& text, const char* option, const std::string& unit);

struct Grid {
  int rows = 0, columns = 0;
};
/// "2x3". Throws UsageError.
Grid panel_grid(const std::string& text);

/// Throws UsageError for an option that the chosen kind of drawing would pass over in silence.
void check_options(const DrawArguments& arguments);

/// Which frames to draw, as indices into the series. Throws UsageError.
std::vector<std::size_t> choose_frames(const DrawArguments& arguments, const std::vector<PvdEntry>& frames);

/// What --window says: two values in the unit of x, two in that of y. Throws UsageError.
std::optional<std::array<double, 4>> window_of(const DrawArguments& arguments, const std::string& x_unit, const std::string& y_unit);

/// The quantity to colour by or to plot.
std::string coloured_by(const DrawArguments& arguments);

/// Where a drawing of this name goes: --output when that is a file, else the folder that it names, else the results' pictures. The folder is
/// created.
std::filesystem::path picture_file(const DrawArguments& arguments, const ResultsFolder& folder, const std::string& name);

/// Says what was written.
void made(const std::filesystem::path& file);

}  // namespace crampon::app
