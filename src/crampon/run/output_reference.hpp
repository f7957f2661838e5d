#pragma once
/// What a run writes, described for users: `crampon quantities`.

#include <string>
#include <vector>

#include "crampon/run/observers/column.hpp"

namespace crampon {

/// As the observers describe them.
const std::vector<ColumnDescription>& describe_history_columns();
/// The description of a column by its name without the unit; null when there is none.
const ColumnDescription* find_description(const std::string& column);

/// Particle quantities, history columns and the other things in files, as Markdown.
std::string output_reference_page();

}  // namespace crampon
