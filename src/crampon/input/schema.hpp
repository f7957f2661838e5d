#pragma once
/// The input's declaration as a JSON Schema, for editors.

#include <string>

#include "crampon/core/record.hpp"

namespace crampon {

/// Draft 4, the newest draft that common TOML editors understand. Ends with a newline.
std::string json_schema();
/// The schema of any record: for tests and for programs with inputs of their own.
std::string json_schema(const Record& root);

}  // namespace crampon
