#pragma once
/// From an input file to a Problem.

#include <string>
#include <vector>

#include "crampon/input/problem.hpp"

namespace crampon {

/// Reads and checks an input file. overrides: settings from the command line, "time.courant=0.2", "body[0].velocity=[1, 0]".
/// Throws InputError with everything that is wrong, in the order of the file.
Problem read_problem(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from text already in memory. name: of the file in diagnostics; directory: files named in the input are relative to it.
Problem read_problem_text(const std::string& text, const std::string& name, const std::string& directory = ".",
                          const std::vector<std::string>& overrides = {});

/// The problem as TOML text with every default explicit, in SI; reading it gives the same problem. It tells what was read, so
/// members changed afterwards in memory do not show.
std::string write_resolved(const Problem& problem);

}  // namespace crampon
