#include <filesystem>

#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/core/closest_name.hpp"
#include "crampon/output/file.hpp"
#include "templates.hpp"

namespace crampon::app {
namespace {

/// The line `title = "..."` of a template.
std::string_view title_of(std::string_view text) {
  constexpr std::string_view opening = "title = \"";
  const std::size_t from = text.find(opening) + opening.size();
  return text.substr(from, text.find('"', from) - from);
}

}  // namespace

int init_command(const InitArguments& arguments) {
  if (arguments.name.empty()) {
    fmt::print("Templates:\n");
    for (const Template& each : templates()) fmt::print("  {:<12} {}\n", each.name, title_of(each.text));
    fmt::print("\nWrite one with: {} init TEMPLATE\n", command_name());
    return exit_ok;
  }
  std::vector<std::string> names;
  for (const Template& each : templates()) {
    names.emplace_back(each.name);
    if (each.name != arguments.name) continue;
    if (arguments.output == "-") {
      fmt::print("{}", each.text);
      return exit_ok;
    }
    const std::string file = arguments.output.empty() ? arguments.name + ".toml" : arguments.output;
    if (std::filesystem::exists(file) && !arguments.force)
      throw UsageError(fmt::format("{}: the file exists; choose another with -o or say --force", file));
    write_file(file, each.text);
    fmt::print("wrote {}; run it with: {} run {}\n", file, command_name(), file);
    return exit_ok;
  }
  throw UsageError(fmt::format("no template \"{}\"; {}", arguments.name, suggest_from(arguments.name, names)));
}

}  // namespace crampon::app
