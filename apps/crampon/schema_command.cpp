#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/run/output_reference.hpp"

namespace crampon::app {

int schema_command() {
  fmt::print("{}", json_schema(output_words()));
  return exit_ok;
}

}  // namespace crampon::app
