#include <csignal>
#include <exception>
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
    return fail(exit_input_error, fmt::format("{} in the input; nothing was written", count == 1 ? "an error" : fmt::format("{} errors", count)));
  } catch (const UsageError& error) {
    return fail(exit_input_error, error.what());
  } catch (const ResultsExist& error) {
    return fail(exit_input_error, error.what());
  } catch (const RunError& error) {
    return fail(exit_run_stopped, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_system_error, "not enough memory; use fewer particles or larger cells (`crampon validate` tells how much is needed)");
  } catch (const std::exception& error) {
    return fail(exit_system_error, error.what());
  } catch (...) {
    return fail(exit_system_error, "unknown error");
  }
}

}  // namespace

int main(int argc, char** argv) {
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
