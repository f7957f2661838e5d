#include "terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "commands.hpp"

namespace crampon::app {

bool is_terminal(std::FILE* stream) { return ::isatty(::fileno(stream)) == 1; }

std::string styled(std::FILE* stream, Style style, std::string_view text) {
  const char* no_color = std::getenv("NO_COLOR");
  if (!is_terminal(stream) || (no_color != nullptr && *no_color != '\0')) return std::string(text);
  const char* code = "0";
  switch (style) {
    case Style::bold:
      code = "1";
      break;
    case Style::red:
      code = "31";
      break;
    case Style::green:
      code = "32";
      break;
    case Style::yellow:
      code = "33";
      break;
    case Style::faint:
      code = "2";
      break;
  }
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string bytes_text(double bytes) {
  const char* unit = "B";
  for (const char* larger : {"kB", "MB", "GB", "TB"}) {
    if (bytes < 1000) break;
    bytes /= 1000;
    unit = larger;
  }
  return fmt::format("{:.3g} {}", bytes, unit);
}

std::string count_text(double count) {
  std::string digits = fmt::format("{:.0f}", count);
  for (auto place = static_cast<std::ptrdiff_t>(digits.size()) - 3; place > (digits[0] == '-' ? 1 : 0); place -= 3)
    digits.insert(static_cast<std::size_t>(place), 1, ' ');
  return digits;
}

std::string load_text(const LoadSummary& load) {
  // Round-off beside the force is none.
  double largest = 0;
  for (const double f : load.force) largest = std::fmax(largest, std::fabs(f));
  std::string force;
  for (const double f : load.force) force += fmt::format("{}{:.6g}", force.empty() ? "" : ", ", std::fabs(f) < 1e-12 * largest ? 0. : f);
  const std::string on = load.area > 0 ? fmt::format(" on {:.6g} m2", load.area) : "";
  return fmt::format("\"{}\": ({}) N{}, largest at t = {:.6g} s", load.name, force, on, load.time);
}

std::string shell_quoted(const std::string& path) {
  const bool plain = !path.empty() && std::all_of(path.begin(), path.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c >= 0x80 || std::string_view("_-./+,:@%=").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return path;
  std::string out = "'";
  for (const char c : path) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

int usable_threads(int asked) { return std::min(asked > 0 ? asked : default_threads(), core_count()); }

std::string threads_note(int asked) {
  const int wanted = asked > 0 ? asked : default_threads();
  if (wanted <= core_count()) return "";
  return fmt::format(
      "{} threads are asked for ({}), but this process has {} core{}: more threads would only wait for each other; it uses {}", wanted,
      asked > 0 ? "--threads" : "OMP_NUM_THREADS", core_count(), core_count() == 1 ? "" : "s", core_count());
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) fmt::print("{} {}\n", styled(stdout, Style::yellow, "note:"), note);
}

namespace {

/// Columns of the terminal; 80 when it does not say.
std::size_t terminal_width(std::FILE* stream) {
  winsize size{};
  return ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

std::string ProgressLine::text(const Progress& p) const {
  const double done = p.end_time > 0 ? std::min(1., p.time / p.end_time) : 1.;
  const double left = done > 0 ? p.wall_seconds * (1 - done) / done : std::numeric_limits<double>::infinity();
  const double rate = p.wall_seconds > 0 ? static_cast<double>(p.step) * static_cast<double>(p.particles) / p.wall_seconds : 0;
  return fmt::format("{:3.0f} %  step {}  t = {:.4g} of {:.4g} s  {} left  {:.2f} M particle-steps/s", std::floor(100 * done),
                     count_text(static_cast<double>(p.step)), p.time, p.end_time, duration_text(left), rate * 1e-6);
}

void ProgressLine::show(const Progress& progress) {
  const double interval = terminal_ ? 0.2 : 5;  // s: as often as one can read, and a log that stays short
  const bool first = last_shown_ == 0;
  // On a terminal a line at once shows that something happens; a log needs none for a run of a second.
  if (progress.wall_seconds - last_shown_ < (terminal_ && first ? 0 : interval)) return;
  last_shown_ = progress.wall_seconds;
  if (terminal_) {
    fmt::print(stderr, "\r{}\x1b[K", text(progress).substr(0, terminal_width(stderr) - 1));  // a line that wraps cannot be taken back
    open_ = true;
  } else {
    fmt::print(stderr, "{}\n", text(progress));
  }
  std::fflush(stderr);
}

void ProgressLine::finish() {
  if (open_) fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  open_ = false;
}

}  // namespace crampon::app
