#include <unistd.h>  // defines __GLIBC__
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>

#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/core/error.hpp"
#include "crampon/output/results_folder.hpp"
#include "terminal.hpp"

namespace {

using namespace crampon;
using namespace crampon::app;

int fail(int code, const std::string& text) {
  fmt::print(stderr, "{} {}\n", styled(stderr, Style::red, "crampon:"), text);
  return code;
}

/// Every error as a text for a person and an exit code for a script.
int explain_error() {
  try {
    throw;
  } catch (const InputError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) fmt::print(stderr, "{}\n", diagnostic.text());
    const std::size_t count = error.diagnostics().size();
    return fail(exit_input_error,
                fmt::format("{} in the input; nothing was written", count == 1 ? "an error" : fmt::format("{} errors", count)));
  } catch (const UsageError& error) {
    return fail(exit_input_error, error.what());
  } catch (const ResultsExist& error) {
    return fail(exit_input_error, error.what());
  } catch (const RunError& error) {
    return fail(exit_run_stopped, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_system_error, "not enough memory; use fewer particles or larger cells (`crampon validate` tells how much is needed)");
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(exit_system_error, fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::exception& error) {
    return fail(exit_system_error, error.what());
  } catch (...) {
    return fail(exit_system_error, "unknown error");
  }
}

/// Threads that wait for each other by spinning run twenty times slower when something else wants their cores (measured with ten
/// busy processes on two cores); sleeping at once costs a few microseconds each time. A short spin has the better of both. The OpenMP
/// library reads this before main() begins, so the program starts itself again. What the user has set is left alone.
void shorten_spinning(char** argv) {
  for (const char* set_by_user : {"GOMP_SPINCOUNT", "OMP_WAIT_POLICY"})
    if (std::getenv(set_by_user) != nullptr) return;
  ::setenv("GOMP_SPINCOUNT", "1000", 0);
  ::execv("/proc/self/exe", argv);  // returns only when it fails; then the run is merely slower
}

/// What is freed goes back to the system at once when it is large. Else the C library, once it has seen large arrays come and go, keeps
/// them and their gaps: a quarter of the memory of a plane run.
void return_large_arrays() {
#ifdef __GLIBC__
  if (!std::getenv("MALLOC_MMAP_THRESHOLD_")) mallopt(M_MMAP_THRESHOLD, 4 << 20);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  shorten_spinning(argv);
  return_large_arrays();
  // A closed pipe (`| head`) and a full quota are reported by the write that meets them.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const int code = run_command_line(argc, argv);
    if (std::fflush(stdout) != 0 && code == exit_ok) return exit_system_error;
    return code;
  } catch (...) {
    return explain_error();
  }
}
