#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/input/reference.hpp"

namespace crampon::app {

int reference_command() {
  fmt::print("{}", reference_page());
  return exit_ok;
}

}  // namespace crampon::app
