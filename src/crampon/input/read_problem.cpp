#include "crampon/input/read_problem.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "crampon/input/check_problem.hpp"
#include "crampon/input/record_reader.hpp"
#include "crampon/input/toml_source.hpp"

namespace crampon {

namespace {

void replace_default(ResolvedTable& root, const std::string& table, const std::string& key, const std::string& text) {
  const auto find = [](ResolvedTable& in, const std::string& name) {
    return std::find_if(in.items.begin(), in.items.end(), [&](const ResolvedTable::Item& item) { return item.key == name; });
  };
  const auto at = find(root, table);
  if (at == root.items.end() || at->tables.empty()) return;
  const auto item = find(at->tables.front(), key);
  if (item != at->tables.front().items.end()) item->text = text;
}

/// A law between bodies says that they are to meet: where it would hold nowhere, since nothing gives them velocity fields of their own and there
/// is nothing else to meet, each has one (a note says so).
void give_fields(Problem& problem, ResolvedTable& resolved) {
  ContactInput& contact = problem.contact;
  if (!contact.keys.contains("default") || contact.keys.contains("fields") || problem.bodies.size() < 2) return;
  if (!problem.walls.empty() || contact.between_fields->bonds()) return;
  if (std::any_of(problem.rigids.begin(), problem.rigids.end(), [](const RigidInput& r) { return r.role == RigidInput::Role::contact; }))
    return;
  if (std::any_of(problem.bodies.begin(), problem.bodies.end(), [](const BodyInput& body) { return body.field.has_value(); })) return;
  contact.fields = FieldsOf::bodies;
  replace_default(resolved, "contact", "fields", "\"bodies\"");
}

}  // namespace

Problem read_problem_text(const std::string& text, const std::string& name, const std::string& directory,
                          const std::vector<std::string>& overrides) {
  Diagnostics diagnostics;
  std::optional<toml::table> root = parse_toml(text, name, diagnostics);
  if (root)
    for (const std::string& setting : overrides) apply_override(*root, setting, diagnostics);
  diagnostics.throw_if_any();

  Problem problem;
  ReadContext context{diagnostics, directory};
  ResolvedTable resolved = read_record(context, problem_declaration(), *root, &problem, "");
  give_fields(problem, resolved);
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
