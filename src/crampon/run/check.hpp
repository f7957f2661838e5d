#pragma once
/// Measured beside expected: the [[expect]] entries of an input against the results of its run.

#include <string>
#include <vector>

#include "crampon/input/problem.hpp"
#include "crampon/output/results_folder.hpp"

namespace crampon {

enum class Verdict {
  met,
  missed,
  not_reached,  ///< the results end before the time that the entry asks for
};

/// One [[expect]] entry; numbers in the unit that the entry names (else SI).
struct CheckRow {
  std::string name;
  std::string figure;  ///< what was measured: "minimum of kinetic_energy, 0 s to 0.001 s"
  std::string unit;
  double measured = 0;  ///< NaN when not reached
  double expected = 0;
  double tolerance = 0;  ///< absolute; the larger one when the entry gives two
  Verdict verdict = Verdict::missed;
  std::string source;
};

/// Evaluates problem.expects. History values stand for any time between rows (linear); particle quantities for the frame nearest in
/// time and the particle nearest to the point in it. The mean is over time, the spread is maximum - minimum. Without `time` the last
/// record counts, without `range` all records. Throws std::runtime_error "path: reason" for unreadable results and for a column or
/// quantity that they lack.
std::vector<CheckRow> check_results(const ResultsFolder& folder, const Problem& problem);

/// The rows as text for a person, a heading first.
std::string check_table(const std::vector<CheckRow>& rows);

}  // namespace crampon
