#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/input/schema.hpp"

namespace crampon::app {

int schema_command() {
  fmt::print("{}", json_schema());
  return exit_ok;
}

}  // namespace crampon::app
