#pragma once
/// What a run writes, described for users: `crampon quantities`.

#include <string>
#include <vector>

namespace crampon {

/// A column of history.csv, or several that differ in a name or an axis.
struct ColumnDescription {
  std::string pattern;  ///< "kinetic_energy", "reaction_AXIS.NAME"; "PROBE.QUANTITY" stands for any other name with a dot
  std::string unit;     ///< empty: that of the quantity
  std::string meaning, formula;
};
const std::vector<ColumnDescription>& describe_history_columns();
/// The description of a column by its name without the unit; null when there is none.
const ColumnDescription* find_description(const std::string& column);

/// Particle quantities, history columns and the other things in files, as Markdown.
std::string output_reference_page();

}  // namespace crampon
