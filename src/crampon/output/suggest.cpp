#include "crampon/output/suggest.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace crampon {
namespace {

// Levenshtein distance: insertions, deletions and substitutions that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string suggest_name(std::string_view unknown, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::size_t best = names.size(), best_distance = std::max<std::size_t>(2, unknown.size() / 3) + 1;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t distance = edit_distance(unknown, names[i]);
    if (distance < best_distance) {
      best = i;
      best_distance = distance;
    }
  }
  if (best < names.size()) return fmt::format("; did you mean \"{}\"?", names[best]);
  return fmt::format("; there are: {}", fmt::join(names, ", "));
}

}  // namespace crampon
