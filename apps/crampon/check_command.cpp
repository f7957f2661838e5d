#include <algorithm>

#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/input/read_problem.hpp"
#include "crampon/run/check.hpp"
#include "terminal.hpp"

namespace crampon::app {

int check_command(const CheckArguments& arguments) {
  const ResultsFolder folder = ResultsFolder::open(arguments.results);
  const Problem problem = read_problem(folder.resolved_input().string());
  const std::vector<CheckRow> rows = check_results(folder, problem);
  if (rows.empty()) {
    fmt::print("{}: its input expects no numbers\n", arguments.results);
    return exit_ok;
  }
  fmt::print("{}", check_table(rows));
  const auto count = [&rows](Verdict verdict) {
    return std::count_if(rows.begin(), rows.end(), [verdict](const CheckRow& row) { return row.verdict == verdict; });
  };
  const auto missed = count(Verdict::missed), beyond = count(Verdict::not_reached);
  const bool good = missed == 0 && (beyond == 0 || arguments.partial);
  fmt::print("\n{}: {} met, {} missed, {} not reached\n", styled(stdout, good ? Style::green : Style::red, good ? "ok" : "MISSED"),
             count(Verdict::met), missed, beyond);
  return good ? exit_ok : exit_check_missed;
}

}  // namespace crampon::app
