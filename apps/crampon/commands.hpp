#pragma once
/// The subcommands: what the command line hands them (command_line.cpp) and where their work begins, one file each.
/// All return the exit code; errors are exceptions, which main() turns into messages and codes.

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace crampon::app {

enum ExitCode {
  exit_ok = 0,
  exit_check_missed = 1,
  exit_input_error = 2,
  exit_run_stopped = 3,
  exit_system_error = 4,
  exit_interrupted = 130
};

/// What was asked for cannot be done as asked. Exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RunArguments {
  std::string input;
  std::string output;  ///< folder; empty: name of the input with .results, in the present folder
  std::vector<std::string> settings;
  int threads = 0;
  std::optional<std::int64_t> steps;  ///< end after so many
  bool force = false, quiet = false;
  bool no_check = false;  ///< do not compare with what is expected
};
int run_command(const RunArguments& arguments);

struct ValidateArguments {
  std::string input;
  std::vector<std::string> settings;
  int threads = 0;
};
int validate_command(const ValidateArguments& arguments);

struct InitArguments {
  std::string name;    ///< of the template; empty: list them
  std::string output;  ///< file; empty: NAME.toml; "-": standard output
  bool force = false;
};
int init_command(const InitArguments& arguments);

struct InfoArguments {
  std::string results;
  bool hash = false;
};
int info_command(const InfoArguments& arguments);

struct DrawArguments {
  std::string results;
  std::string quantity;
  std::vector<int> frames;  ///< negative: from the end
  std::vector<std::string> times;
  bool all = false;
  std::string panel;  ///< "2x3"; empty: one picture per moment
  double magnify = 1;
  std::vector<std::string> range;   ///< two values
  std::vector<std::string> window;  ///< four values
  std::string palette;              ///< empty: chosen by the quantity
  bool symmetric = false;
  bool tip_names = false;
  bool fringes = false;
  std::optional<double> fringe_constant;  ///< 1/MPa
  std::vector<std::string> history;       ///< columns, or "name [unit] = formula of columns"
  std::string against;                    ///< column for the horizontal axis, likewise; empty: time
  std::string profile;                    ///< "x", "y" or "z": plot the quantity of each particle over this coordinate
  bool mean = false;                      ///< of the particles in strips of a cell's width along that coordinate
  std::vector<std::string> over;          ///< "label = formula of x, y or z and t", drawn over a profile
  std::vector<std::string> compare;       ///< further results folders whose histories join the plot
  std::optional<std::string> title;       ///< else the run's
  int width = 1200;
  std::string output;
};
int draw_command(const DrawArguments& arguments);

struct CheckArguments {
  std::string results;
  bool partial = false;  ///< entries that the run did not reach are no misses
};
int check_command(const CheckArguments& arguments);

int schema_command();
int reference_command();
int quantities_command();

/// Threads to use: as many as asked for (0: default_threads()), but no more than there are cores for this process.
int usable_threads(int asked);
/// Why fewer threads are used than were asked for, by option or environment; empty when they are not.
std::string threads_note(int asked);

/// Reads the arguments and calls a subcommand. Returns the exit code; throws what the subcommand throws.
int run_command_line(int argc, const char* const* argv);

/// How the user calls this program: "crampon", or "./run.sh" when that did.
std::string command_name();

}  // namespace crampon::app
