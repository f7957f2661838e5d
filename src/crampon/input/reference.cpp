#include "crampon/input/reference.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>

#include "crampon/input/problem.hpp"
#include "crampon/input/resolved.hpp"

namespace crampon {
namespace {

using Kind = Entry::Kind;

std::string code(const std::string& text) { return "`" + text + "`"; }

// A cell of a table must not hold a bar.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

// The anchor that Markdown renderers give a heading.
std::string anchor(const std::string& heading) {
  std::string out;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-') out += static_cast<char>(std::tolower(c));
    if (c == ' ') out += '-';
  }
  return out;
}
std::string link(const std::string& text, const std::string& heading) { return fmt::format("[{}](#{})", text, anchor(heading)); }

class PageWriter {
 public:
  std::string write(const Record& root) {
    out_ =
        "# Input reference\n\n"
        "Generated from the declarations in the source; `crampon schema` prints the same as a JSON Schema for editors.\n\n"
        "One TOML file describes one run.\n\n"
        "- A **quantity** is a number in SI (`0.018`) or text with a unit (`\"18 mm\"`); its dimension is checked. Units: "
        "`mm`, `ms`, `MPa`, `g/cm3`, `mm/ms`, `deg`, `1/s`, `MPa*sqrt(m)` and whatever else UDUNITS-2 knows.\n"
        "- A **function** is a quantity, or `{ expression = \"2*sin(pi*t)\", unit = \"mm/s\" }` in `t` (s), `x`, `y`, `z` (m) with "
        "`sin`, `cos`, `exp`, `sqrt`, `abs`, `min`, `max`, `if(condition, yes, no)` ..., or a table linear in time and constant outside, "
        "`{ times = [\"0 s\", \"1 ms\"], values = [0, \"3 mm/s\"] }`, or the same from a file with lines `time,value` in SI, "
        "`{ file = \"pull.csv\", unit = \"mm/s\" }`. A factor to SI, `scale = 1e-3`, may stand in place of `unit`.\n"
        "- A **list** of quantities may hold numbers and text side by side: `[\"0 mm\", 0.018]`. Where one value is enough it needs no "
        "brackets.\n"
        "- A key that is not listed here is an error.\n";
    section(2, "Top level", root);
    at_top_ = false;
    // Tables and families are mentioned on the way, also by each other.
    std::size_t records = 0, families = 0;
    while (records < records_.size() || families < families_.size()) {
      if (records < records_.size()) {
        const Part part = records_[records++];
        section(2, part.heading, *part.record);
        continue;
      }
      const AnyFamily& family = *families_[families++];
      out_ += fmt::format("\n## {}\n\n{} Chosen by {}.\n", heading_of(family), family.help(), code(family.tag_key()));
      for (const Alternative& alternative : family.alternatives()) section(3, alternative.name(), *alternative.record);
    }
    return out_;
  }

 private:
  struct Part {
    std::string heading;
    const Record* record;
  };
  std::string out_;
  bool at_top_ = true;
  std::vector<Part> records_;
  std::vector<const AnyFamily*> families_;

  static std::string heading_of(const AnyFamily& family) {
    std::string heading = family.name();
    heading.front() = static_cast<char>(std::toupper(heading.front()));
    return heading + " family";
  }

  // Only tables of the top level are written with their brackets alone.
  std::string heading_of(const char* open, const Entry& entry, const char* close) const {
    if (at_top_) return code(open + entry.key + close);
    // Tables of one key in several records.
    const std::string& name = entry.record().name();
    return name == entry.key ? code(entry.key) : fmt::format("{} ({})", code(entry.key), name);
  }

  std::string mention(const Entry& entry, const std::string& heading) {
    const Record* record = &entry.record();
    const auto known = std::find_if(records_.begin(), records_.end(), [&](const Part& p) { return p.record == record; });
    if (known != records_.end()) return known->heading;
    records_.push_back({heading, record});
    return heading;
  }
  std::string mention(const AnyFamily& family) {
    if (std::find(families_.begin(), families_.end(), &family) == families_.end()) families_.push_back(&family);
    return heading_of(family);
  }

  void section(int level, const std::string& heading, const Record& record) {
    out_ += fmt::format("\n{} {}\n\n{}\n", std::string(static_cast<std::size_t>(level), '#'), heading, record.help());
    if (record.entries().empty()) {
      out_ += "\nNo keys of its own.\n";
      return;
    }
    out_ += "\n| key | type | unit | default | bounds | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
    const std::shared_ptr<void> defaults = record.create();
    for (const Entry& entry : record.entries()) {
      std::string help = entry.help;
      for (const Entry& other : record.entries()) {
        const auto names = [](const Entry& a, const Entry& b) {
          return std::find(a.excludes.begin(), a.excludes.end(), b.key) != a.excludes.end();
        };
        if (names(entry, other) || names(other, entry)) help += "; not together with " + code(other.key);
      }
      out_ += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(entry.key), cell(type_text(entry)), cell(unit_text(entry)),
                          cell(default_text(record, entry, defaults.get())), cell(bounds_text(entry)), cell(help));
    }
  }

  std::string type_text(const Entry& entry) {
    switch (entry.kind) {
      case Kind::quantity:
        return "quantity";
      case Kind::quantities:
        return "list of quantities";
      case Kind::points:
        return "list of points";
      case Kind::integer:
        return "integer";
      case Kind::integers:
        return "list of integers";
      case Kind::flag:
        return "`true` or `false`";
      case Kind::text:
        return entry.file ? "path" : entry.name ? "name" : "text";
      case Kind::texts:
        return "list of texts";
      case Kind::choice: {
        std::string words;
        for (const std::string& word : entry.choices) words += (words.empty() ? "" : ", ") + code("\"" + word + "\"");
        return words;
      }
      case Kind::function:
        return "function";
      case Kind::functions:
        return "list of functions";
      case Kind::record:
        return link("table", mention(entry, heading_of("[", entry, "]")));
      case Kind::records:
        return link("array of tables", mention(entry, heading_of("[[", entry, "]]")));
      case Kind::one_of:
        return link(entry.family().name(), mention(entry.family()));
      case Kind::one_of_list:
        return "list of " + link(entry.family().name(), mention(entry.family()));
      case Kind::inline_one_of:
        return link(entry.family().name(), mention(entry.family())) + ", with its keys beside it";
    }
    return "";
  }

  static std::string unit_text(const Entry& entry) {
    if (entry.unit == "1" || entry.unit.empty()) return "";
    if (entry.unit == "any") return "any";
    if (entry.units.empty()) return entry.unit;
    std::vector<std::string> units;
    for (const auto& [word, unit] : entry.units)
      if (std::find(units.begin(), units.end(), unit) == units.end()) units.push_back(unit);
    return fmt::format("{} by {}", fmt::join(units, " or "), code(entry.unit_key));
  }

  static std::string default_text(const Record& record, const Entry& entry, const void* defaults) {
    if (entry.presence == Presence::required) return "**required**";
    if (entry.name) return "numbered";
    if (entry.plain()) {
      const std::string text = toml_text(entry.get(defaults));
      return text.empty() || text == "\"\"" ? "" : code(text);
    }
    if (entry.kind == Kind::one_of || entry.kind == Kind::inline_one_of) {
      ResolvedTable table;
      add_defaults(table, record, entry, defaults);
      if (table.items.empty()) return "";
      const auto& item = table.items.front();
      return code(item.tables.empty() ? item.text : item.tables.front().items.front().text);
    }
    return "";
  }

  static std::string bounds_text(const Entry& entry) {
    std::string text = entry.bounds.text();
    if (!entry.length.text().empty())
      text +=
          fmt::format("{}{} {}", text.empty() ? "" : "; ", entry.length.text(), entry.kind == Kind::points ? "coordinates each" : "values");
    return text;
  }
};

}  // namespace

std::string reference_page() { return reference_page(problem_declaration()); }
std::string reference_page(const Record& root) { return PageWriter().write(root); }

}  // namespace crampon
