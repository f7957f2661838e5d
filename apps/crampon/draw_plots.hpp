#pragma once
/// `crampon draw --history` and `--profile`: line plots.

#include <string>

#include "commands.hpp"
#include "crampon/output/results_folder.hpp"

namespace crampon::app {

/// Columns of histories, and formulas of them, over time or each other.
void draw_history(const DrawArguments& arguments, const ResultsFolder& folder, const std::string& title);

/// The quantity of the particles in the window over one coordinate, one set of marks for each frame; formulas as lines over them.
void draw_profile(const DrawArguments& arguments, const ResultsFolder& folder, const std::string& title);

}  // namespace crampon::app
