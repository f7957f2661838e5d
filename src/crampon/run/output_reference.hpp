#pragma once
/// What a run writes, described for users: `crampon quantities`.

#include <string>
#include <vector>

#include "crampon/input/schema.hpp"
#include "crampon/run/observers/column.hpp"

namespace crampon {

/// As the observers describe them.
const std::vector<ColumnDescription>& describe_history_columns();
/// The description of a column by its name without the unit; null when there is none.
const ColumnDescription* find_description(const std::string& column);

/// The words of the input that name output: particle quantities of all laws, and the history columns that do not hold a name of the input.
KnownWords output_words();

/// Particle quantities, history columns and the other things in files, as Markdown.
std::string output_reference_page();

}  // namespace crampon
