#include "crampon/input/toml_source.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "crampon/input/resolved.hpp"

namespace crampon {
namespace {

constexpr std::string_view setting_prefix = "--set ";

// Length of the UTF-8 sequence at `text[k]`, 0 when it is malformed, overlong, a surrogate or beyond U+10FFFF.
std::size_t utf8_length(std::string_view text, std::size_t k) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(k);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : (first & 0xF0) == 0xE0        ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(k + i) & 0xC0) != 0x80) return 0;
  const unsigned second = byte(k + 1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) || (first == 0xF0 && second < 0x90) ||
      (first == 0xF4 && second >= 0x90))
    return 0;
  return length;
}

// The first character that must not reach the parser.
bool refuse_bad_characters(const std::string& text, const std::string& file, Diagnostics& diagnostics) {
  int line = 1, column = 1;
  for (std::size_t k = 0; k < text.size();) {
    const unsigned c = static_cast<unsigned char>(text[k]);
    const bool control = (c < 0x20 && c != '\t' && c != '\n' && !(c == '\r' && k + 1 < text.size() && text[k + 1] == '\n')) || c == 0x7F;
    const std::size_t length = utf8_length(text, k);
    if (control || length == 0) {
      diagnostics.add(Location{file, line, column, ""},
                      control ? fmt::format("control character 0x{:02X}", c) : fmt::format("byte 0x{:02X} is not UTF-8", c),
                      "an input is plain UTF-8 text", "remove it");
      return true;
    }
    if (c == '\n') {
      ++line;
      column = 0;
    }
    ++column;
    k += length;
  }
  return false;
}

struct PathStep {
  std::string key;
  std::optional<std::size_t> index;  ///< set: an element of an array, key is empty
};

// "body[0].velocity"; nothing when it is malformed.
std::optional<std::vector<PathStep>> split_path(std::string_view path) {
  std::vector<PathStep> steps;
  std::size_t k = 0;
  while (k < path.size()) {
    const std::size_t end = std::min(path.find_first_of(".[", k), path.size());
    if (end == k) return std::nullopt;
    steps.push_back({std::string(path.substr(k, end - k)), std::nullopt});
    k = end;
    while (k < path.size() && path[k] == '[') {
      std::size_t index = 0;
      const auto [stop, error] = std::from_chars(path.data() + k + 1, path.data() + path.size(), index);
      k = static_cast<std::size_t>(stop - path.data());
      if (error != std::errc() || k >= path.size() || path[k] != ']') return std::nullopt;
      ++k;
      steps.push_back({"", index});
    }
    if (k < path.size() && (path[k] != '.' || ++k == path.size())) return std::nullopt;
  }
  if (steps.empty()) return std::nullopt;
  return steps;
}

std::string trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string_view::npos ? "" : std::string(text.substr(begin, end - begin + 1));
}

}  // namespace

namespace {

// The parser descends once for every part of a dotted key; no key of ours has more than a few.
bool refuse_deep_keys(const std::string& text, const std::string& file, Diagnostics& diagnostics) {
  constexpr std::ptrdiff_t most_parts = 100;
  int line = 1;
  for (std::size_t from = 0; from < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    for (std::size_t at = from; at < end;) {  // dots between what may separate keys from values
      const std::size_t stop = std::min(text.find_first_of("=,{}[]\"'#", at), end);
      if (std::count(text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(stop), '.') > most_parts) {
        diagnostics.add(Location{file, line, static_cast<int>(at - from + 1), ""}, "a key of more than a hundred parts",
                        "keys are grouped in tables, at most a few deep", "correct the key");
        return true;
      }
      at = stop + 1;
    }
    from = end + 1;
  }
  return false;
}

}  // namespace

std::optional<toml::table> parse_toml(const std::string& text, const std::string& file, Diagnostics& diagnostics) {
  if (text.size() > largest_input) {
    diagnostics.add(Location{file, 0, 0, ""}, fmt::format("the input has {} bytes", text.size()),
                    fmt::format("at most {} are read", largest_input), "put particles and tables into files of their own");
    return std::nullopt;
  }
  if (refuse_bad_characters(text, file, diagnostics) || refuse_deep_keys(text, file, diagnostics)) return std::nullopt;
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    diagnostics.add(locate(error.source(), ""), std::string(error.description()), "the file is not valid TOML", "mend the syntax here");
    return std::nullopt;
  }
}

void apply_override(toml::table& root, const std::string& setting, Diagnostics& diagnostics) {
  const std::string origin = std::string(setting_prefix) + setting;
  const auto complain = [&](const std::string& what, const std::string& why, const std::string& remedy) {
    diagnostics.add(Location{origin, 0, 0, ""}, what, why, remedy);
  };
  const std::size_t equals = setting.find('=');
  const auto steps = split_path(trim(setting.substr(0, equals)));
  if (equals == std::string::npos || !steps || steps->front().index) {
    complain("not a setting", "a setting is a path, = and a value", "write it as time.courant=0.2 or body[0].thickness=\"2 mm\"");
    return;
  }
  const std::string value_text = setting.substr(equals + 1);
  if (refuse_bad_characters(value_text, origin, diagnostics)) return;
  toml::table holder;
  try {
    // Line breaks would let a setting smuggle in further keys.
    if (value_text.find('\n') == std::string::npos) holder = toml::parse("v = " + value_text, origin);
  } catch (const toml::parse_error&) {}
  if (holder.size() != 1) holder = toml::parse("v = " + toml_quoted(trim(value_text)), origin);
  toml::node& value = *holder.get("v");
  // Copies of a node forget where it stood; moved ones remember.
  const auto insert = [&](toml::table& table, const std::string& key, toml::node& node) -> toml::node& {
    node.visit([&](auto& concrete) { table.insert_or_assign(toml::key(key, node.source()), std::move(concrete)); });
    return *table.get(key);
  };

  toml::node* here = &root;
  for (std::size_t k = 0; k < steps->size(); ++k) {
    const PathStep& step = (*steps)[k];
    const bool last = k + 1 == steps->size();
    if (step.index) {
      toml::array* array = here->as_array();
      if (!array || *step.index >= array->size()) {
        complain(fmt::format("there is no element [{}]", *step.index),
                 array ? fmt::format("the array has {}, counted from 0", array->size()) : "the entry is not an array", "correct the path");
        return;
      }
      if (last) {
        const auto place = array->cbegin() + static_cast<std::ptrdiff_t>(*step.index);
        value.visit([&](auto& concrete) { array->replace(place, std::move(concrete)); });
        return;
      }
      here = array->get(*step.index);
    } else {
      toml::table* table = here->as_table();
      if (!table) {
        complain(fmt::format("\"{}\" cannot be set", step.key), "what stands before it is not a table",
                 "correct the path; elements of an array are chosen by [0]");
        return;
      }
      if (last) {
        insert(*table, step.key, value);
        return;
      }
      here = table->get(step.key);
      if (!here) {
        toml::table made = toml::parse("v = {}", origin);
        here = &insert(*table, step.key, *made.get("v"));
      }
    }
  }
}

Location locate(const toml::source_region& region, const std::string& where) {
  Location location;
  location.where = where;
  if (region.path) location.file = *region.path;
  if (!location.file.starts_with(setting_prefix)) {
    location.line = static_cast<int>(region.begin.line);
    location.column = static_cast<int>(region.begin.column);
  }
  return location;
}

std::string describe_type(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return node.is_array_of_tables() ? "an array of tables" : "an array";
    case toml::node_type::string:
      return "text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return node.value_or(false) ? "true" : "false";
    case toml::node_type::none:
      break;
    default:
      return "a date or time";
  }
  return "nothing";
}

}  // namespace crampon
