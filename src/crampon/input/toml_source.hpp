#pragma once
/// The text of an input file as TOML nodes that know where they stand.

#include <optional>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "crampon/core/record.hpp"

namespace crampon {

/// Largest input text, bytes. Particles and tables belong in files of their own.
inline constexpr std::size_t largest_input = std::size_t{16} << 20;

/// Parses `text`; what is wrong goes to `diagnostics` and nothing is returned. Control characters and malformed UTF-8 are refused
/// before the parser sees them (its preconditions exclude them).
std::optional<toml::table> parse_toml(const std::string& text, const std::string& file, Diagnostics& diagnostics);

/// Sets one entry from "time.courant=0.2", "body[0].velocity=[1, 2]". What is no TOML value is taken as text: title=My beam.
void apply_override(toml::table& root, const std::string& setting, Diagnostics& diagnostics);

/// Place of a node; settings from the command line have no line.
Location locate(const toml::source_region& region, const std::string& where);

/// "an integer", "a table": for messages.
std::string describe_type(const toml::node& node);

}  // namespace crampon
