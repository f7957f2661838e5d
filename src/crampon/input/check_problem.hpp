#pragma once
/// Rules that reach across the tables of an input and need no engine: names, dimensions, places inside the grid.

#include "crampon/input/problem.hpp"

namespace crampon {

/// Reports at the keys concerned. Tables that were themselves in error (already in `diagnostics`) are left alone, so that one
/// mistake is told once.
void check_problem(const Problem& problem, Diagnostics& diagnostics);

}  // namespace crampon
