#include "crampon/input/read_problem.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "crampon/input/check_problem.hpp"
#include "crampon/input/record_reader.hpp"
#include "crampon/input/toml_source.hpp"

namespace crampon {

Problem read_problem_text(const std::string& text, const std::string& name, const std::string& directory,
                          const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  std::optional<toml::table> root = parse_toml(text, name, diagnostics);
  if (root)
    for (const std::string& setting : overrides) apply_override(*root, setting, diagnostics);
  diagnostics.throw_if_any();

  Problem problem;
  ReadContext context{diagnostics, directory};
  const ResolvedTable resolved = read_record(context, problem_declaration(), *root, &problem, "");
  check_problem(problem, diagnostics);
  diagnostics.throw_if_any();
  problem.written = std::move(context.written);
  problem.source = text;
  problem.directory = directory;
  problem.resolved = write_toml(resolved);
  return problem;
}

Problem read_problem(const std::string& path, const std::vector<std::string>& overrides) {
  const auto fail = [&](const std::string& what, const std::string& why, const std::string& remedy) {
    Diagnostics diagnostics;
    diagnostics.add(Location{path, 0, 0, ""}, what, why, remedy);
    diagnostics.throw_if_any();
  };
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail("there is no such file", "the input is read from it", "correct the path");
  if (std::filesystem::is_directory(path, error)) fail("this is a directory", "an input is one TOML file", "name the file in it");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail("the file cannot be opened", "reading is not allowed", "check its permissions");
  std::string text;
  text.resize(largest_input + 1);  // one more than is accepted, so that parse_toml sees what is too long
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad()) fail("the file cannot be read", "the system reported an error", "try again");
  const std::string directory = std::filesystem::path(path).parent_path().string();
  return read_problem_text(text, path, directory.empty() ? "." : directory, overrides);
}

std::string write_resolved(const Problem& problem) { return problem.resolved; }

}  // namespace crampon
