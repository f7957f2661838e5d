#pragma once
/// An input with nothing left open: every key with its value in SI, defaults included, as it is written to input.resolved.toml.

#include <string>
#include <vector>

#include "crampon/core/record.hpp"

namespace crampon {

/// One table of the resolved input, keys in the order of the declaration.
struct ResolvedTable {
  struct Item {
    enum class Kind { plain, table, tables };
    std::string key;
    Kind kind = Kind::plain;
    std::string text;     ///< plain: the value as TOML
    std::string comment;  ///< plain: its unit
    std::vector<ResolvedTable> tables;
  };
  std::vector<Item> items;

  void add_plain(const Entry& entry, const EntryValue& value, const std::string& unit);
  void add_table(const std::string& key, ResolvedTable table);
  void add_tables(const std::string& key, std::vector<ResolvedTable> tables);
};

/// The value as TOML; empty when there is nothing to write (not given, empty list).
std::string toml_text(const EntryValue& value);
/// A quoted TOML string.
std::string toml_quoted(const std::string& text);

/// What an object holds, for keys that the input leaves out.
void add_defaults(ResolvedTable& table, const Record& record, const Entry& entry, const void* object);
ResolvedTable resolve_object(const Record& record, const void* object);

/// The whole file: plain keys first, then [tables] and [[arrays of tables]]; what is deeper stands in inline tables.
std::string write_toml(const ResolvedTable& root);

}  // namespace crampon
