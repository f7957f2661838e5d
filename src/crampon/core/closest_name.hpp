#pragma once
/// "Did you mean": the known name that a misspelt one stands for.

#include <optional>
#include <string>
#include <vector>

namespace crampon {

/// The candidate with the smallest edit distance (insert, delete, replace, swap of neighbours) to `word`, letter case counting
/// little; nothing when even that one needs more than a third of the letters changed. Ties: the first candidate.
std::optional<std::string> closest_name(const std::string& word, const std::vector<std::string>& candidates);

/// "did you mean \"cell\"?", or "choose from: cell, origin" when nothing is close.
std::string suggest_from(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace crampon
