#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "crampon/core/predicates.hpp"
#include "crampon/run/notes/notes.hpp"

namespace crampon {

namespace {

/// How near cracks are that lie on each other, and over how much of their length, in cells. Cracks that cross at five degrees or more
/// are not that near over that length.
constexpr double near_cells = 0.01, long_cells = 0.25;

struct Segment {
  std::size_t crack = 0, number = 0;
  Vec<2> a, b;                  ///< m
  double begins = 0, ends = 0;  ///< along the crack, m
};

/// Segments of all cracks by the cells that they touch.
class SegmentCells {
 public:
  explicit SegmentCells(const Start<2>& start) : grid_(start.model.grid) {
    for (std::size_t c = 0; c < start.state.cracks.size(); ++c) {
      const auto& plane = start.state.cracks.list[c].plane;
      double along = 0;
      for (std::size_t s = 0; s + 1 < plane.size(); ++s) {
        const double length = norm(plane[s + 1] - plane[s]);
        segments_.push_back({c, s, plane[s], plane[s + 1], along, along + length});
        along += length;
      }
      lengths_.push_back(along);
    }
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const Segment& s = segments_[i];
      IndexVector<2> low{}, high{};
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = index(std::fmin(s.a[k], s.b[k]) - near_cells * grid_.cell[k], k);
        high[k] = index(std::fmax(s.a[k], s.b[k]) + near_cells * grid_.cell[k], k);
      }
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) cells_[grid_.node_number({x, y})].push_back(i);
      }
    }
  }

  const std::vector<Segment>& segments() const { return segments_; }
  double length(std::size_t crack) const { return lengths_[crack]; }
  const std::vector<std::size_t>& at(const Vec<2>& x) const { return cells_.at(grid_.node_number({index(x[0], 0), index(x[1], 1)})); }

 private:
  int index(double x, std::size_t k) const { return static_cast<int>(std::floor((x - grid_.origin[k]) * grid_.inverse_cell[k])); }

  const Grid<2>& grid_;
  std::vector<Segment> segments_;
  std::vector<double> lengths_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

double distance_to(const Segment& s, const Vec<2>& x) {
  const Vec<2> along = s.b - s.a;
  const double t = std::clamp(dot(x - s.a, along) / dot(along, along), 0., 1.);
  return norm(x - (s.a + t * along));
}

/// Where two segments cross; nothing for parallel ones.
std::optional<Vec<2>> crossing_of(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (std::fmax(a[k], b[k]) < std::fmin(c[k], d[k]) || std::fmax(c[k], d[k]) < std::fmin(a[k], b[k])) return {};
  }
  if (orient_sign(a, b, c) * orient_sign(a, b, d) > 0 || orient_sign(c, d, a) * orient_sign(c, d, b) > 0) return {};
  const double sine = cross(b - a, d - c);
  if (std::fabs(sine) <= 1e-9 * norm(b - a) * norm(d - c)) return {};
  return a + (cross(c - a, d - c) / sine) * (b - a);
}

/// First place at which a polyline crosses or touches itself; its ends may lie on it, as those of a closed one do. Points as stated, since a
/// division of its segments may put vertices just there.
std::optional<Vec<2>> first_crossing(const std::vector<std::vector<double>>& stated, double slack) {
  std::vector<Vec<2>> points;
  for (const std::vector<double>& p : stated) points.push_back({{p[0], p[1]}});
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    for (std::size_t j = i + 2; j + 1 < points.size(); ++j) {
      const auto x = crossing_of(points[i], points[i + 1], points[j], points[j + 1]);
      if (x && norm(*x - points.front()) > slack && norm(*x - points.back()) > slack) return x;
    }
  }
  return {};
}

/// Length over which the first of two cracks lies on the second, m; of a crack with itself: over which it runs back.
std::map<std::pair<std::size_t, std::size_t>, double> find_overlaps(const SegmentCells& cells, double h) {
  std::map<std::pair<std::size_t, std::size_t>, double> overlaps;
  for (const Segment& s : cells.segments()) {
    constexpr int samples = 8;
    for (int k = 0; k < samples; ++k) {
      const double part = (k + 0.5) / samples, along = s.begins + part * (s.ends - s.begins);
      const Vec<2> x = s.a + part * (s.b - s.a);
      std::vector<std::size_t> counted;  // a crack counts once
      for (const std::size_t i : cells.at(x)) {
        const Segment& t = cells.segments()[i];
        if (t.crack < s.crack || std::find(counted.begin(), counted.end(), t.crack) != counted.end()) continue;
        // On its own crack: a place further along, which is not merely the next around a bend or past the ends of a closed one.
        const double apart = t.begins - along;
        if (t.crack == s.crack && (apart < long_cells * h || cells.length(s.crack) - apart < 2 * long_cells * h)) continue;
        if (distance_to(t, x) > near_cells * h) continue;
        counted.push_back(t.crack);
        overlaps[{s.crack, t.crack}] += (s.ends - s.begins) / samples;
      }
    }
  }
  return overlaps;
}

}  // namespace

template <int Dim>
void note_tangled_cracks(const Start<Dim>& start, Notes& notes) {
  if constexpr (Dim == 2) {  // cracks are lines in the plane
    const double h = start.model.grid.smallest_cell();
    const std::vector<CrackInput>& cracks = start.problem.cracks;
    const auto place = [&](std::size_t crack) -> const Location& { return cracks[crack].at(cracks[crack].arc ? "arc" : "points"); };
    const SegmentCells cells(start);
    for (std::size_t c = 0; c < cracks.size(); ++c) {
      if (const auto x = first_crossing(cracks[c].points, 1e-6 * h))
        notes.push_back({place(c), fmt::format("the crack \"{}\" crosses itself at {}", cracks[c].name, place_text(*x)),
                         "a line that crosses it twice counts as crossing nothing",
                         "divide it into cracks that do not, or correct its points"});
    }
    for (const auto& [pair, length] : find_overlaps(cells, h)) {
      const auto [a, b] = pair;
      if (length < std::fmin(long_cells * h, 0.5 * std::fmin(cells.length(a), cells.length(b)))) continue;
      if (a == b)
        notes.push_back({place(a), fmt::format("the crack \"{}\" runs back over itself for {:.3g} m", cracks[a].name, length),
                         "a line that crosses it twice counts as crossing nothing", "correct its points"});
      else
        notes.push_back(
            {place(b), fmt::format("the cracks \"{}\" and \"{}\" coincide over {:.3g} m", cracks[a].name, cracks[b].name, length),
             "there is nothing between them, and the stricter of their two contact laws holds", "remove one of them, or part them"});
    }
  }
}

template void note_tangled_cracks(const Start<2>&, Notes&);
template void note_tangled_cracks(const Start<3>&, Notes&);

}  // namespace crampon
