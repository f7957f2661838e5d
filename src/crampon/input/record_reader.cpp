#include "crampon/input/record_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "crampon/core/closest_name.hpp"
#include "crampon/input/toml_source.hpp"

namespace crampon {
namespace {

using Kind = Entry::Kind;

std::string join_path(const std::string& where, const std::string& key) { return where.empty() ? key : where + "." + key; }

// Reads one table. The keys of an alternative chosen inline stand in the same table, so it reads those as well.
class TableReader {
 public:
  // place: of the table, or of the word that stands for it.
  TableReader(ReadContext& context, const toml::table& table, const toml::source_region& place, std::string where)
      : context_(context), table_(table), where_(std::move(where)) {
    here_.location = locate(place, where_);
    for (const auto& [key, node] : table_)
      here_.keys[std::string(key.str())] = locate(key.source(), join_path(where_, std::string(key.str())));
  }

  // tag: a key that the caller has read already.
  ResolvedTable read(const Record& record, void* object, const std::string& tag = "") {
    if (!tag.empty()) known_.push_back(tag);
    ResolvedTable resolved = read_entries(record, object);
    report_unknown_keys(record.name());
    finish(record, object);
    for (const auto& [alternative, held] : inline_choices_) finish(*alternative->record, held.get());
    if (good())
      for (const auto& build : builds_) build();
    if (good()) {
      context_.diagnostics.enter(here_);
      record.check(object, context_.diagnostics);
    }
    return resolved;
  }

  bool good() const { return context_.diagnostics.list().size() == before_; }

 private:
  ReadContext& context_;
  const toml::table& table_;
  std::string where_;
  std::size_t before_ = context_.diagnostics.list().size();
  Located here_;
  std::vector<std::string> known_;
  std::set<std::string> excused_;  // keys that cannot be judged because the alternative is not known
  std::vector<std::pair<const Alternative*, std::shared_ptr<void>>> inline_choices_;
  std::vector<std::function<void()>> builds_;

  void complain(const toml::source_region& region, const std::string& where, std::string what, std::string why, std::string remedy) {
    context_.diagnostics.add(locate(region, where), std::move(what), std::move(why), std::move(remedy));
  }

  void finish(const Record& record, void* object) {
    if (Located* located = record.located(object)) *located = here_;
  }

  ResolvedTable read_entries(const Record& record, void* object) {
    ResolvedTable resolved;
    for (const Entry& entry : record.entries()) known_.push_back(entry.key);
    for (const Entry& entry : record.entries()) {
      const toml::node* node = table_.get(entry.key);
      if (node) {
        read_entry(resolved, record, entry, *node, object);
      } else if (entry.presence == Presence::required) {
        report_missing(entry);
        if (entry.kind == Kind::inline_one_of) excuse_alternatives(entry.family());
      } else if (!excluded(record, entry)) {
        add_defaults(resolved, record, entry, object);
        place_defaults(entry, object);
      }
    }
    report_contradictions(record);
    return resolved;
  }

  // Does a given key rule out this one, by its own declaration or by the other's?
  bool excluded(const Record& record, const Entry& entry) const {
    const auto given = [&](const std::string& key) { return table_.contains(key); };
    return std::any_of(entry.excludes.begin(), entry.excludes.end(), given) ||
           std::any_of(record.entries().begin(), record.entries().end(), [&](const Entry& other) {
             return given(other.key) && std::find(other.excludes.begin(), other.excludes.end(), entry.key) != other.excludes.end();
           });
  }

  void report_contradictions(const Record& record) {
    for (const Entry& entry : record.entries())
      for (const std::string& other : entry.excludes)
        if (table_.contains(entry.key) && table_.contains(other))
          context_.diagnostics.add(here_.at(entry.key), fmt::format("\"{}\" and \"{}\" are both given", other, entry.key),
                                   "they contradict each other", "remove one of them");
  }

  // A table that the input leaves out stands where its parent stands.
  void place_defaults(const Entry& entry, void* object) {
    if (entry.kind != Kind::record || entry.parts(object).empty()) return;
    if (Located* located = entry.record().located(entry.emplace(object))) {
      located->location = here_.location;
      located->location.where = join_path(where_, entry.key);
    }
  }

  void report_missing(const Entry& entry) {
    const bool table = entry.kind == Kind::record && where_.empty(), tables = entry.kind == Kind::records && where_.empty();
    const std::string shown = table ? "[" + entry.key + "]" : tables ? "[[" + entry.key + "]]" : entry.key;
    context_.diagnostics.add(here_.location, fmt::format("{} is missing", table || tables ? shown : "the key \"" + shown + "\""),
                             entry.help, table || tables ? fmt::format("add a table {}", shown) : fmt::format("add {} = ...", shown));
  }

  void excuse_alternatives(const AnyFamily& family) {
    for (const Alternative& a : family.alternatives())
      for (const Entry& e : a.record->entries()) excused_.insert(e.key);
  }

  void report_unknown_keys(const std::string& record_name) {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(known_.begin(), known_.end(), name) != known_.end() || excused_.contains(name)) continue;
      complain(key.source(), join_path(where_, name), "unknown key", fmt::format("{} has no such key", record_name),
               suggest_from(name, known_));
    }
  }

  void read_entry(ResolvedTable& resolved, const Record& record, const Entry& entry, const toml::node& node, void* object) {
    const std::string where = join_path(where_, entry.key);
    switch (entry.kind) {
      case Kind::record:
        return read_sub_record(resolved, entry, node, object, where);
      case Kind::records:
        return read_records(resolved, entry, node, object, where);
      case Kind::one_of:
        return read_one_of(resolved, entry, node, object, where);
      case Kind::one_of_list:
        return read_list_of(resolved, entry, node, object, where);
      case Kind::inline_one_of:
        return read_inline(resolved, entry, node, object, where);
      default:
        break;
    }
    const std::string unit = record.unit_of(entry, object);
    const auto value = read_value(context_, entry, unit, node, where, here_.keys);
    if (!value) return;
    entry.set(object, *value);
    // The resolved input stands in the results folder: paths must not depend on where it is read from.
    const bool path = entry.file && std::holds_alternative<std::string>(*value);
    resolved.add_plain(
        entry,
        path ? EntryValue(std::filesystem::absolute(resolve_path(context_, std::get<std::string>(*value))).string()) : entry.get(object),
        unit);
  }

  const toml::table* expect_table(const toml::node& node, const Entry& entry, const std::string& where) {
    if (const toml::table* table = node.as_table()) return table;
    std::string remedy = fmt::format("write {} = {{ ... }}", entry.key);
    if (entry.list())
      remedy = where_.empty() ? fmt::format("write [[{}]]", entry.key) : fmt::format("write {} = [{{ ... }}, ...]", entry.key);
    if (!entry.list() && where_.empty())
      remedy = fmt::format("write [{}]{}", entry.key, node.is_array_of_tables() ? " with single brackets" : "");
    complain(node.source(), where, fmt::format("{} where a table is expected", describe_type(node)), entry.help, remedy);
    return nullptr;
  }

  const toml::array* expect_tables(const toml::node& node, const Entry& entry, const std::string& where) {
    const toml::array* array = node.as_array();
    if (!array) {
      const std::string remedy = node.is_table() && where_.empty() ? fmt::format("write [[{}]] with double brackets", entry.key)
                                                                   : fmt::format("write {} = [{{ ... }}, ...]", entry.key);
      complain(node.source(), where, fmt::format("{} where an array of tables is expected", describe_type(node)), entry.help, remedy);
      return nullptr;
    }
    const std::size_t least = std::max<std::size_t>(entry.length.least, entry.presence == Presence::required ? 1 : 0);
    if (array->size() < least || array->size() > entry.length.most) {
      const Length length{least, entry.length.most};
      complain(node.source(), where, fmt::format("{} tables where {} are expected", array->size(), length.text()), entry.help,
               "add or remove some");
      return nullptr;
    }
    return array;
  }

  void read_sub_record(ResolvedTable& resolved, const Entry& entry, const toml::node& node, void* object, const std::string& where) {
    if (const toml::table* table = expect_table(node, entry, where))
      resolved.add_table(entry.key, read_record(context_, entry.record(), *table, entry.emplace(object), where));
  }

  void read_records(ResolvedTable& resolved, const Entry& entry, const toml::node& node, void* object, const std::string& where) {
    const toml::array* array = expect_tables(node, entry, where);
    if (!array) return;
    const Record& record = entry.record();
    const Entry* name = record.name_entry();
    std::map<std::string, int> names;  // to the line where each was first used
    std::vector<ResolvedTable> tables;
    for (std::size_t k = 0; k < array->size(); ++k) {
      const std::string element = fmt::format("{}[{}]", where, k);
      const toml::table* table = expect_table(*array->get(k), entry, element);
      if (!table) continue;
      void* sub = entry.emplace(object);
      if (name && name->presence == Presence::optional) name->set(sub, EntryValue(fmt::format("{}{}", entry.key, k + 1)));
      tables.push_back(read_record(context_, record, *table, sub, element));
      if (!name) continue;
      const std::string text = std::get<std::string>(name->get(sub));
      const toml::node* given = table->get(name->key);
      const Location place = locate(given ? given->source() : table->source(), join_path(element, name->key));
      const auto [first, added] = names.emplace(text, place.line);
      if (!added && !text.empty())
        context_.diagnostics.add(place, fmt::format("the name \"{}\" is used twice", text), fmt::format("first in line {}", first->second),
                                 "choose another name");
    }
    resolved.add_tables(entry.key, std::move(tables));
  }

  // The alternative of a family that a table asks for, with its resolved keys; nullptr when that failed (and was reported).
  std::shared_ptr<void> read_alternative(const Entry& entry, const toml::node& node, const std::string& where, const Alternative*& chosen,
                                         ResolvedTable& resolved) {
    const AnyFamily& family = entry.family();
    const toml::table empty;
    const toml::table* table = nullptr;
    const toml::node* tag = nullptr;
    if (node.is_string()) {  // contact = "bonded": an alternative by its name alone
      tag = &node;
      table = &empty;
    } else {
      table = expect_table(node, entry, where);
      if (!table) return nullptr;
      tag = table->get(family.tag_key());
      if (!tag) {
        complain(table->source(), where, fmt::format("the key \"{}\" is missing", family.tag_key()),
                 fmt::format("it names the {}", family.name()), fmt::format("add {} = \"{}\"", family.tag_key(), names_of(family).front()));
        return nullptr;
      }
    }
    chosen = find_alternative(family, *tag, node.is_string() ? where : join_path(where, family.tag_key()));
    if (!chosen) return nullptr;
    const std::size_t before = context_.diagnostics.list().size();
    std::shared_ptr<void> object = chosen->record->create();
    if (node.is_string() && needs_keys(*chosen->record)) {
      complain(node.source(), where, fmt::format("\"{}\" needs further keys", chosen->name()), chosen->record->help(),
               fmt::format("write {} = {{ {} = \"{}\", ... }}", entry.key, family.tag_key(), chosen->name()));
      return nullptr;
    }
    resolved = TableReader(context_, *table, node.source(), where).read(*chosen->record, object.get(), family.tag_key());
    resolved.items.insert(resolved.items.begin(),
                          {family.tag_key(), ResolvedTable::Item::Kind::plain, toml_quoted(chosen->name()), "", {}});
    return context_.diagnostics.list().size() == before ? object : nullptr;
  }

  static bool needs_keys(const Record& record) {
    return std::any_of(record.entries().begin(), record.entries().end(), [](const Entry& e) { return e.presence == Presence::required; });
  }

  static std::vector<std::string> names_of(const AnyFamily& family) {
    std::vector<std::string> names;
    for (const Alternative& a : family.alternatives()) names.push_back(a.name());
    return names;
  }

  const Alternative* find_alternative(const AnyFamily& family, const toml::node& tag, const std::string& where) {
    const auto* text = tag.as_string();
    if (!text) {
      complain(tag.source(), where, fmt::format("{} where text is expected", describe_type(tag)),
               fmt::format("it names the {}", family.name()), suggest_from("", names_of(family)));
      return nullptr;
    }
    const Alternative* found = family.find(text->get());
    if (!found)
      complain(tag.source(), where, fmt::format("unknown {} {}", family.name(), toml_quoted(text->get().substr(0, 60))), family.help(),
               suggest_from(text->get(), names_of(family)));
    return found;
  }

  void build(const Entry& entry, const Alternative& chosen, void* held, void* object, const toml::node& node, const std::string& where) {
    try {
      entry.assign(object, chosen.build(held));
    } catch (const std::invalid_argument& error) {
      complain(node.source(), where, error.what(), chosen.record->help(), "correct the parameters");
    }
  }

  void read_one_of(ResolvedTable& resolved, const Entry& entry, const toml::node& node, void* object, const std::string& where) {
    const Alternative* chosen = nullptr;
    ResolvedTable table;
    if (const auto held = read_alternative(entry, node, where, chosen, table)) {
      build(entry, *chosen, held.get(), object, node, where);
      resolved.add_table(entry.key, std::move(table));
    }
  }

  void read_list_of(ResolvedTable& resolved, const Entry& entry, const toml::node& node, void* object, const std::string& where) {
    const toml::array* array = expect_tables(node, entry, where);
    if (!array) return;
    std::vector<ResolvedTable> tables;
    for (std::size_t k = 0; k < array->size(); ++k) {
      const std::string element = fmt::format("{}[{}]", where, k);
      const Alternative* chosen = nullptr;
      ResolvedTable table;
      if (const auto held = read_alternative(entry, *array->get(k), element, chosen, table)) {
        build(entry, *chosen, held.get(), object, *array->get(k), element);
        tables.push_back(std::move(table));
      }
    }
    resolved.add_tables(entry.key, std::move(tables));
  }

  void read_inline(ResolvedTable& resolved, const Entry& entry, const toml::node& tag, void* object, const std::string& where) {
    const Alternative* chosen = find_alternative(entry.family(), tag, where);
    if (!chosen) return excuse_alternatives(entry.family());
    std::shared_ptr<void> held = chosen->record->create();
    resolved.items.push_back({entry.key, ResolvedTable::Item::Kind::plain, toml_quoted(chosen->name()), "", {}});
    ResolvedTable keys = read_entries(*chosen->record, held.get());
    for (ResolvedTable::Item& item : keys.items) resolved.items.push_back(std::move(item));
    inline_choices_.emplace_back(chosen, held);
    builds_.push_back([this, &entry, chosen, held, object, &tag, where] {
      context_.diagnostics.enter(here_);
      chosen->record->check(held.get(), context_.diagnostics);
      if (good()) build(entry, *chosen, held.get(), object, tag, where);
    });
  }
};

}  // namespace

ResolvedTable read_record(ReadContext& context, const Record& record, const toml::table& table, void* object, const std::string& where) {
  return TableReader(context, table, table.source(), where).read(record, object);
}

}  // namespace crampon
