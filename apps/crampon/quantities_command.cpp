#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/run/output_reference.hpp"

namespace crampon::app {

int quantities_command() {
  fmt::print("{}", output_reference_page());
  return exit_ok;
}

}  // namespace crampon::app
