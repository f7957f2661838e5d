#include "crampon/input/resolved.hpp"

#include <cmath>

#include <fmt/format.h>

namespace crampon {
namespace {

// Shortest text that reads back to the same bits, and reads as a float.
std::string number_text(double x) {
  std::string text = fmt::format("{}", x);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

template <class List, class ToText>
std::string list_text(const List& list, ToText to_text) {
  if (list.empty()) return "";
  std::string out;
  for (const auto& item : list) out += (out.empty() ? "[" : ", ") + to_text(item);
  return out + "]";
}

std::string numbers_text(const std::vector<double>& list) { return list_text(list, number_text); }

std::string inline_text(const ResolvedTable& table) {
  std::string out;
  const auto add = [&](const std::string& key, const std::string& value) { out += (out.empty() ? " " : ", ") + key + " = " + value; };
  for (const ResolvedTable::Item& item : table.items) {
    if (item.kind == ResolvedTable::Item::Kind::plain) add(item.key, item.text);
    if (item.kind == ResolvedTable::Item::Kind::table) add(item.key, inline_text(item.tables.front()));
    if (item.kind == ResolvedTable::Item::Kind::tables) add(item.key, list_text(item.tables, inline_text));
  }
  return "{" + out + " }";
}

void write_table(std::string& out, const std::string& header, const ResolvedTable& table) {
  out += "\n" + header + "\n";
  for (const ResolvedTable::Item& item : table.items) {
    out += item.key + " = ";
    if (item.kind == ResolvedTable::Item::Kind::plain) out += item.text;
    if (item.kind == ResolvedTable::Item::Kind::table) out += inline_text(item.tables.front());
    if (item.kind == ResolvedTable::Item::Kind::tables) out += list_text(item.tables, inline_text);
    if (!item.comment.empty()) out += "  # " + item.comment;
    out += "\n";
  }
}

}  // namespace

std::string toml_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string toml_text(const EntryValue& value) {
  struct Visitor {
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(std::int64_t x) const { return fmt::format("{}", x); }
    std::string operator()(double x) const { return number_text(x); }
    std::string operator()(const std::string& x) const { return toml_quoted(x); }
    std::string operator()(const std::vector<double>& x) const { return numbers_text(x); }
    std::string operator()(const std::vector<std::int64_t>& x) const {
      return list_text(x, [](std::int64_t i) { return fmt::format("{}", i); });
    }
    std::string operator()(const std::vector<std::string>& x) const { return list_text(x, toml_quoted); }
    std::string operator()(const std::vector<std::vector<double>>& x) const { return list_text(x, numbers_text); }
    std::string operator()(const ValueFunction& x) const { return x.text(); }
    std::string operator()(const std::vector<ValueFunction>& x) const {
      return list_text(x, [](const ValueFunction& f) { return f.text(); });
    }
  };
  return std::visit(Visitor{}, value);
}

void ResolvedTable::add_plain(const Entry& entry, const EntryValue& value, const std::string& unit) {
  std::string text = toml_text(value);
  if (!text.empty()) items.push_back({entry.key, Item::Kind::plain, std::move(text), unit == "1" || unit == "any" ? "" : unit, {}});
}

void ResolvedTable::add_table(const std::string& key, ResolvedTable table) {
  items.push_back({key, Item::Kind::table, "", "", {std::move(table)}});
}

void ResolvedTable::add_tables(const std::string& key, std::vector<ResolvedTable> tables) {
  if (!tables.empty()) items.push_back({key, Item::Kind::tables, "", "", std::move(tables)});
}

namespace {
// The tag and the keys of the alternative that a family value shows; empty when it hides them.
ResolvedTable resolve_choice(const AnyFamily& family, const std::string& tag_key, const void* value) {
  ResolvedTable table;
  if (const Alternative* a = family.holding(value)) {
    table = resolve_object(*a->record, a->view(value));
    table.items.insert(table.items.begin(), {tag_key, ResolvedTable::Item::Kind::plain, toml_quoted(a->name()), "", {}});
  }
  return table;
}
}  // namespace

void add_defaults(ResolvedTable& table, const Record& record, const Entry& entry, const void* object) {
  if (entry.plain()) {
    table.add_plain(entry, entry.get(object), record.unit_of(entry, object));
    return;
  }
  std::vector<ResolvedTable> parts;
  for (const void* part : entry.parts(object)) {
    if (entry.record) {
      parts.push_back(resolve_object(entry.record(), part));
    } else {
      const bool inline_choice = entry.kind == Entry::Kind::inline_one_of;
      ResolvedTable choice = resolve_choice(entry.family(), inline_choice ? entry.key : entry.family().tag_key(), part);
      if (!choice.items.empty()) parts.push_back(std::move(choice));
    }
  }
  if (entry.list()) {
    table.add_tables(entry.key, std::move(parts));
  } else if (!parts.empty() && entry.kind == Entry::Kind::inline_one_of) {
    for (ResolvedTable::Item& item : parts.front().items) table.items.push_back(std::move(item));
  } else if (!parts.empty()) {
    table.add_table(entry.key, std::move(parts.front()));
  }
}

ResolvedTable resolve_object(const Record& record, const void* object) {
  ResolvedTable table;
  for (const Entry& entry : record.entries()) add_defaults(table, record, entry, object);
  return table;
}

std::string write_toml(const ResolvedTable& root) {
  std::string out = "# Every key with its value, defaults included, in SI. Reading this file gives the same problem.\n";
  for (const ResolvedTable::Item& item : root.items)
    if (item.kind == ResolvedTable::Item::Kind::plain) out += item.key + " = " + item.text + "\n";
  for (const ResolvedTable::Item& item : root.items)
    if (item.kind != ResolvedTable::Item::Kind::plain)
      for (const ResolvedTable& table : item.tables)
        write_table(out, item.kind == ResolvedTable::Item::Kind::table ? "[" + item.key + "]" : "[[" + item.key + "]]", table);
  return out;
}

}  // namespace crampon
