#pragma once
/// Walks a declaration against TOML tables: fills the struct, reports everything that is wrong, and notes the resolved input.

#include "crampon/input/resolved.hpp"
#include "crampon/input/value_reader.hpp"

namespace crampon {

/// Fills `object` (of the type that `record` declares) from `table`. where: path of the table, "" for the file itself.
ResolvedTable read_record(ReadContext& context, const Record& record, const toml::table& table, void* object, const std::string& where);

}  // namespace crampon
