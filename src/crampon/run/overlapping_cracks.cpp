#include "crampon/run/overlapping_cracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace crampon {

namespace {

struct Segment {
  std::size_t crack = 0;
  Vec<2> a, b;
  Vec<2> low, high;  ///< corners of its box, m
};

std::vector<Segment> segments_of(const std::vector<Crack<2>>& cracks) {
  std::vector<Segment> out;
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    for (const auto& [i, j] : cracks[c].facets) {
      Segment s{c, cracks[c].plane[i], cracks[c].plane[j], {}, {}};
      for (int k = 0; k < 2; ++k) s.low[k] = std::min(s.a[k], s.b[k]), s.high[k] = std::max(s.a[k], s.b[k]);
      out.push_back(s);
    }
  }
  std::sort(out.begin(), out.end(), [](const Segment& s, const Segment& t) { return s.low[0] < t.low[0]; });
  return out;
}

/// Length of s that lies within `slack` of t, m.
double shared_length(const Segment& s, const Segment& t, double slack) {
  const double length = norm(s.b - s.a);
  if (!(length > 0)) return 0;
  const Vec<2> along = (s.b - s.a) * (1 / length), across{{-along[1], along[0]}};
  // The part of t within the strip about the line of s, then what of it lies beside s.
  double from = 0, to = 1;
  const double start = dot(t.a - s.a, across), rise = dot(t.b - t.a, across);
  if (rise == 0) {
    if (std::fabs(start) > slack) return 0;
  } else {
    const double at_one = (-slack - start) / rise, at_other = (slack - start) / rise;
    from = std::max(from, std::min(at_one, at_other));
    to = std::min(to, std::max(at_one, at_other));
    if (to <= from) return 0;
  }
  const double x = dot(t.a - s.a, along), dx = dot(t.b - t.a, along);
  const double one = x + from * dx, other = x + to * dx;
  return std::max(std::min(std::max(one, other), length) - std::max(std::min(one, other), 0.), 0.);
}

}  // namespace

std::vector<std::string> overlapping_cracks(const std::vector<Crack<2>>& cracks, double cell) {
  const double slack = 1e-3 * cell;
  const std::vector<Segment> segments = segments_of(cracks);
  std::map<std::pair<std::size_t, std::size_t>, double> shared;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    for (std::size_t j = i + 1; j < segments.size() && segments[j].low[0] <= s.high[0] + slack; ++j) {
      const Segment& t = segments[j];
      if (s.crack == t.crack || t.low[1] > s.high[1] + slack || s.low[1] > t.high[1] + slack) continue;
      shared[std::minmax(s.crack, t.crack)] += shared_length(s, t, slack);
    }
  }
  std::vector<std::string> notes;
  for (const auto& [pair, length] : shared) {
    // What lines that merely cross share within the slack is a few times the slack, but for very small angles.
    if (length < 0.05 * cell) continue;
    notes.push_back(fmt::format(
        "the cracks \"{}\" and \"{}\" lie on each other over {:.4g} m, where the stricter of their two contact laws holds, once; "
        "leave one out if it is a copy of the other",
        cracks[pair.first].name, cracks[pair.second].name, length));
  }
  return notes;
}

}  // namespace crampon
