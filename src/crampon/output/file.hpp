#pragma once
/// Whole files, written so that a reader never meets a half of one.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace crampon {

/// Writes bytes to a temporary neighbour and renames it onto path, so that path is either the old file or the whole new one.
/// Throws std::runtime_error "path: cannot write: reason" (disk full, no permission, ...) and removes the temporary file.
void write_file(const std::filesystem::path& path, std::string_view bytes);
/// The same for a file in pieces.
void write_file(const std::filesystem::path& path, const std::vector<std::string>& pieces);

/// Content of a file. Throws std::runtime_error "path: cannot read: reason".
std::string read_file(const std::filesystem::path& path);

/// Name of the temporary neighbour of path while it is written; a killed run may leave one behind.
std::filesystem::path partial_name(const std::filesystem::path& path);

}  // namespace crampon
