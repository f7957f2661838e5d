#pragma once
/// Plain values: from a TOML node to what an entry takes, in SI, with everything wrong reported where it stands.

#include <map>
#include <optional>
#include <string>

#include <toml++/toml.h>

#include "crampon/core/record.hpp"

namespace crampon {

/// What reading one input needs everywhere.
struct ReadContext {
  Diagnostics& diagnostics;
  std::string directory;                            ///< files named in the input are relative to it
  std::map<std::string, std::string> written = {};  ///< texts of quantities of any dimension, by place ("expect[0].value")
};

/// Reads a plain entry. unit: of this entry in this record. Elements of lists leave their places in `places` as "points[2]".
/// Returns nothing when something was wrong (and reported).
std::optional<EntryValue> read_value(ReadContext& context, const Entry& entry, const std::string& unit, const toml::node& node,
                                     const std::string& where, std::map<std::string, Location>& places);

/// The path of a file named in the input.
std::string resolve_path(const ReadContext& context, const std::string& path);

}  // namespace crampon
