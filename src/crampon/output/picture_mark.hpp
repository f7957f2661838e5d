#pragma once
/// The mark in every picture that this program draws, by which `run --force` knows it among pictures of others.

#include <filesystem>
#include <string>

namespace crampon {

/// Adds the mark to a PNG file in memory: the text "Software: Crampon", which viewers show among the file's properties.
void mark_picture(std::string& png);
bool is_marked_picture(const std::filesystem::path& path);

}  // namespace crampon
