#include "crampon/output/crack_tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crampon {

std::vector<FrameTip> tips_of(const CrackFrame& frame) {
  std::vector<FrameTip> tips;
  for (std::size_t c = 0; c < frame.names.size(); ++c) {
    const auto first = static_cast<std::size_t>(frame.begin[c]), end = static_cast<std::size_t>(frame.begin[c + 1]);
    for (std::size_t v = first; v < end; ++v) {
      const double status = value_at(frame, "tip_status", v);
      if (!(status >= 0 && status < static_cast<double>(tip_status_words.size()))) continue;
      tips.push_back({c, v, v != first, static_cast<TipStatus>(static_cast<int>(status))});
    }
  }
  return tips;
}

double value_at(const CrackFrame& frame, const std::string& quantity, std::size_t vertex) {
  for (const DataArray& field : frame.fields)
    if (field.name == quantity && field.components == 1) return field.values[vertex];
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<std::pair<std::size_t, std::size_t>> vertices_before(const CrackFrame& frame, std::size_t crack, const CrackFrame& earlier) {
  const auto found = std::find(earlier.names.begin(), earlier.names.end(), frame.names[crack]);
  if (found == earlier.names.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(found - earlier.names.begin());
  const auto first = static_cast<std::size_t>(frame.begin[crack]), end = static_cast<std::size_t>(frame.begin[crack + 1]);
  const auto first_then = static_cast<std::size_t>(earlier.begin[k]), end_then = static_cast<std::size_t>(earlier.begin[k + 1]);
  if (frame.original.size() == frame.plane.size() && earlier.original.size() == earlier.plane.size() && end_then > first_then) {
    // Vertices keep their places in the undeformed body to the bit, and new ones join at the ends.
    const auto same = [&](std::size_t now, std::size_t then) {
      return std::equal(frame.original.begin() + static_cast<std::ptrdiff_t>(3 * now),
                        frame.original.begin() + static_cast<std::ptrdiff_t>(3 * now + 3),
                        earlier.original.begin() + static_cast<std::ptrdiff_t>(3 * then));
    };
    const std::size_t more = end_then - first_then - 1;
    for (std::size_t v = first; v + more < end; ++v)
      if (same(v, first_then) && same(v + more, end_then - 1)) return std::pair{v, v + more};
  }
  return std::pair{first, end - 1};
}

}  // namespace crampon
