#pragma once
/// The input's declaration as a JSON Schema, for editors.

#include <map>
#include <string>
#include <vector>

#include "crampon/core/record.hpp"

namespace crampon {

/// Words that texts of the input may hold, by the name of their list (Entry::words).
using KnownWords = std::map<std::string, std::vector<std::string>>;

/// Draft 4, the newest draft that common TOML editors understand. Ends with a newline.
/// \param known  words that editors are offered where a text takes them; other texts stay allowed there
std::string json_schema(const KnownWords& known = {});
/// The schema of any record: for tests and for programs with inputs of their own.
std::string json_schema(const Record& root, const KnownWords& known = {});

}  // namespace crampon
