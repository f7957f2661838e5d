#include "crampon/input/function_table.hpp"

#include <charconv>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "crampon/core/closest_name.hpp"
#include "crampon/core/units.hpp"
#include "crampon/input/toml_source.hpp"

namespace crampon {
namespace {

const std::vector<std::string> known_keys = {"expression", "unit", "scale", "times", "values", "file"};

Entry plain_entry(Entry::Kind kind, std::string key, std::string unit, std::string help) {
  Entry e;
  e.kind = kind;
  e.key = std::move(key);
  e.unit = std::move(unit);
  e.help = std::move(help);
  return e;
}

class FunctionTableReader {
 public:
  FunctionTableReader(ReadContext& context, const toml::table& table, std::string unit, std::string where)
      : context_(context), table_(table), unit_(std::move(unit)), where_(std::move(where)), before_(context.diagnostics.list().size()) {}

  std::optional<ValueFunction> read() {
    for (const auto& [key, node] : table_)
      if (std::find(known_keys.begin(), known_keys.end(), key.str()) == known_keys.end())
        context_.diagnostics.add(locate(key.source(), where_ + "." + std::string(key.str())), "unknown key", "a function has no such key",
                                 suggest_from(std::string(key.str()), known_keys));
    const bool expression = table_.contains("expression"), in_file = table_.contains("file"),
               inline_table = table_.contains("times") || table_.contains("values");
    if (expression + in_file + inline_table != 1)
      return complain(table_, expression + in_file + inline_table == 0 ? "the function is not given" : "the function is given twice",
                      "it is an expression, a table of times and values, or a file",
                      "write { expression = \"...\" }, { times = [...], values = [...] } or { file = \"...\" }");
    for (const char* key : {"unit", "scale"})
      if (inline_table && table_.contains(key))
        complain(*table_.get(key), fmt::format("a table of values takes no {}", key), "its values carry their units",
                 "write values = [\"1 mm\", ...]");
    if (table_.contains("unit") && table_.contains("scale"))
      complain(*table_.get("scale"), "\"unit\" and \"scale\" are both given", "they contradict each other", "remove one of them");
    if (!good()) return std::nullopt;
    try {
      return expression ? read_expression() : inline_table ? read_table() : read_file();
    } catch (const std::invalid_argument& error) {
      return complain(table_, error.what(), "the function cannot be used", "correct it");
    }
  }

 private:
  ReadContext& context_;
  const toml::table& table_;
  std::string unit_, where_;
  std::size_t before_;
  std::map<std::string, Location> places_;

  bool good() const { return context_.diagnostics.list().size() == before_; }
  std::nullopt_t complain(const toml::node& node, std::string what, std::string why, std::string remedy) {
    context_.diagnostics.add(locate(node.source(), where_), std::move(what), std::move(why), std::move(remedy));
    return std::nullopt;
  }
  template <class V>
  std::optional<V> value(const Entry& entry) {
    const toml::node* node = table_.get(entry.key);
    if (!node) {
      complain(table_, fmt::format("the key \"{}\" is missing", entry.key), entry.help, fmt::format("add {}", entry.key));
      return std::nullopt;
    }
    const auto read = read_value(context_, entry, entry.unit, *node, where_ + "." + entry.key, places_);
    return read ? std::optional<V>(std::get<V>(*read)) : std::nullopt;
  }
  // What the values are multiplied by to be in SI, from "unit" or "scale"; nothing when it is wrong.
  std::optional<double> factor() {
    if (table_.contains("scale")) return value<double>(plain_entry(Entry::Kind::quantity, "scale", "1", "factor from the values to SI"));
    if (!table_.contains("unit")) return 1.;
    const auto text = value<std::string>(plain_entry(Entry::Kind::text, "unit", "", "the unit of the values"));
    if (!text) return std::nullopt;
    try {
      return unit_factor(*text, unit_);
    } catch (const UnitError& error) {
      return complain(*table_.get("unit"), error.what, error.why, error.remedy);
    }
  }

  std::optional<ValueFunction> read_expression() {
    const auto text = value<std::string>(plain_entry(Entry::Kind::text, "expression", "", "a formula of t, x, y, z and pi in SI"));
    const auto scale = factor();
    if (!text || !scale) return std::nullopt;
    try {
      return ValueFunction::expression(*text, *scale);
    } catch (const std::invalid_argument& error) {
      return complain(*table_.get("expression"), error.what(), "it is a formula of t (s), x, y, z (m) and pi",
                      "write for example \"2*sin(pi*t)\" or \"if(t < 1e-3, 1, 0)\"");
    }
  }

  std::optional<ValueFunction> read_table() {
    const auto times = value<std::vector<double>>(plain_entry(Entry::Kind::quantities, "times", "s", "times of the table"));
    const auto values = value<std::vector<double>>(plain_entry(Entry::Kind::quantities, "values", unit_, "one value for each time"));
    if (!times || !values) return std::nullopt;
    return ValueFunction::table(*times, *values);
  }

  // Two columns, time in s and value; empty lines, # comments and a first line of words are passed over.
  std::optional<ValueFunction> read_file() {
    Entry entry = plain_entry(Entry::Kind::text, "file", "", "a CSV file with the columns time and value");
    entry.file = true;
    const auto name = value<std::string>(entry);
    const auto scale = factor();
    if (!name || !scale) return std::nullopt;
    std::ifstream in(resolve_path(context_, *name));
    std::vector<double> times, values;
    std::string line;
    int count = 0;
    bool first = true;
    while (std::getline(in, line)) {
      if (++count == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // a byte order mark
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.find_first_not_of(" \t") == std::string::npos || line[line.find_first_not_of(" \t")] == '#') continue;
      const bool may_be_header = std::exchange(first, false);
      double pair[2];
      if (read_two(line, pair)) {
        times.push_back(pair[0]);
        values.push_back(*scale * pair[1]);
      } else if (!may_be_header || !is_header(line)) {
        return complain(*table_.get("file"), fmt::format("line {} of the file is not \"time,value\"", count),
                        "each line holds two numbers and a comma", "correct the file");
      }
    }
    if (times.empty())
      return complain(*table_.get("file"), "the file holds no times", "a table has at least one", "add lines \"time,value\"");
    return ValueFunction::table(std::move(times), std::move(values));
  }

  // Two words and a comma; no number, good or bad.
  static bool is_header(const std::string& line) {
    const auto begins_word = [&](std::size_t at) {
      at = line.find_first_not_of(" \t\"", at);
      if (at == std::string::npos || (std::isalpha(static_cast<unsigned char>(line[at])) == 0 && line[at] != '_')) return false;
      const std::string start = line.substr(at, 3);
      return start != "nan" && start != "inf" && start != "NaN" && start != "Inf";
    };
    const std::size_t comma = line.find(',');
    return comma != std::string::npos && begins_word(0) && begins_word(comma + 1);
  }

  static bool read_two(const std::string& line, double (&pair)[2]) {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (int k = 0; k < 2; ++k) {
      while (at < end && (*at == ' ' || *at == '\t' || *at == '+')) ++at;
      const auto [stop, error] = std::from_chars(at, end, pair[k]);
      if (error != std::errc() || !std::isfinite(pair[k])) return false;
      at = stop;
      while (at < end && (*at == ' ' || *at == '\t')) ++at;
      if (k == 0 && (at == end || *at++ != ',')) return false;
    }
    return at == end;
  }
};

}  // namespace

std::optional<ValueFunction> read_function_table(ReadContext& context, const toml::table& table, const std::string& unit,
                                                 const std::string& where) {
  return FunctionTableReader(context, table, unit, where).read();
}

}  // namespace crampon
