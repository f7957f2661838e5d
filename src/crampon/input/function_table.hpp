#pragma once
/// Functions of time and place as a table: {expression, unit}, {times, values} or {file, unit}; a factor `scale` may stand for the unit.

#include <optional>
#include <string>

#include <toml++/toml.h>

#include "crampon/input/value_reader.hpp"

namespace crampon {

/// unit: the SI unit of the function's value.
std::optional<ValueFunction> read_function_table(ReadContext& context, const toml::table& table, const std::string& unit,
                                                 const std::string& where);

}  // namespace crampon
