#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

template <int Dim>
void note_late_output(const Start<Dim>& start, Notes& notes) {
  const Problem& problem = start.problem;
  const double end = start.end_time * (1 + 1e-6);  // many steps add up with round-off
  const std::string why = fmt::format("the run ends at {}{:.6g} s", problem.time.end ? "" : "about ", start.end_time);
  const auto note = [&](const Located& record, const std::string& key, std::string what, const char* remedy) {
    notes.push_back({record.at(key), std::move(what), why, remedy});
  };
  const OutputInput& output = problem.output;
  std::size_t late = 0;
  for (std::size_t k = output.times.size(); k-- > 0 && output.times[k] > end;) late = output.times.size() - k;
  if (late > 0) {
    const std::size_t first = output.times.size() - late;
    note(output, fmt::format("times[{}]", first),
         fmt::format("{} of the {} times of frames {} after the end, from {:.6g} s on", late, output.times.size(), late == 1 ? "is" : "are",
                     output.times[first]),
         "correct the times or let the run last longer");
  }
  if (output.every && *output.every > end)
    note(output, "every", fmt::format("the first frame after the start would be due at {:.6g} s", *output.every),
         "make it shorter; only the first and the last state are written");
  if (output.history_every && *output.history_every > end)
    note(output, "history_every", fmt::format("the first history row after the start would be due at {:.6g} s", *output.history_every),
         "make it shorter; the history has only its first and last row");
  for (const ExpectInput& expect : problem.expects) {
    const char* remedy = "correct the time or let the run last longer";
    if (expect.time && *expect.time > end)
      note(expect, "time", fmt::format("\"{}\" is expected at {:.6g} s, after the end", expect.name, *expect.time), remedy);
    if (expect.range.size() == 2 && expect.range[1] > end)
      note(expect, "range", fmt::format("\"{}\" is expected until {:.6g} s, after the end", expect.name, expect.range[1]), remedy);
  }
  for (const BoundaryInput& boundary : problem.boundaries) {
    if (boundary.start > end)
      note(boundary, "start", fmt::format("\"{}\" starts at {:.6g} s, after the end", boundary.name, boundary.start), "start it earlier");
  }
}

template void note_late_output(const Start<2>&, Notes&);
template void note_late_output(const Start<3>&, Notes&);

}  // namespace crampon
