#pragma once
/// What the program shows, and how: colours only on a terminal and without NO_COLOR (https://no-color.org).

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "crampon/run/run_problem.hpp"

namespace crampon::app {

enum class Style { bold, red, green, yellow, faint };

bool is_terminal(std::FILE* stream);

/// text, in a style where the stream shows colours.
std::string styled(std::FILE* stream, Style style, std::string_view text);

/// "1.5 ms", "12.3 s", "4 min 10 s", "3 h 05 min".
std::string duration_text(double seconds);
/// "950 B", "12.3 MB", "1.8 GB".
std::string bytes_text(double bytes);
/// 1234567 as "1 234 567".
std::string count_text(double count);

/// The force of a load where it is largest: "pull": (0, 2000) N on 2e-05 m2, largest at t = 5e-05 s.
std::string load_text(const LoadSummary& load);

/// A path as a shell takes it: in quotes where it has blanks or other signs of the shell's.
std::string shell_quoted(const std::string& path);

/// "note: ..." on stdout, a line each.
void print_notes(const std::vector<std::string>& notes);

/// Progress of a run on stderr: one line rewritten in place on a terminal, a plain line every few seconds elsewhere.
class ProgressLine {
 public:
  void show(const Progress& progress);
  /// Ends the line; what is printed next starts on a fresh one.
  void finish();

 private:
  std::string text(const Progress& progress) const;

  bool terminal_ = is_terminal(stderr);
  double last_shown_ = 0;  // wall s of the run
  bool open_ = false;
};

}  // namespace crampon::app
