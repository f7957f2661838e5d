#include "crampon/geometry/fill.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "crampon/geometry/plane_cut.hpp"

namespace crampon {
namespace {

using Index = std::array<int, 3>;

constexpr double boundary_tolerance = 1e-9;              // of the smallest sub-cell size
constexpr std::int64_t whole_part = 1 << 24;             // a covered part is a whole number of these: 6e-8 of a sub-cell
constexpr std::int64_t share_denominator = 27720;        // divisible by 1..12: up to 12 neighbours share alike
constexpr std::int64_t least_own_part = whole_part / 5;  // of a sub-cell that gets a particle though its centre is outside
constexpr double furthest_off = 0.49;                    // of the middle of its sub-cell, in its edges: a particle stays in its own
constexpr std::int64_t whole_weight = whole_part * share_denominator;

enum class Cover : std::uint8_t { none, partial, full };

// A part of a sub-cell, or the weight of a particle, in whole fractions of a sub-cell.
struct Part {
  std::int64_t measure = 0;
  std::array<std::int64_t, 3> moment{};  // about the middle of the sub-cell, in its edges
};

// The shape seen on the sub-lattice: the range of cells that its bounds reach, and how much of each the shape covers.
class Lattice {
 public:
  Lattice(const Region& shape, const FillGrid& grid, const Index& per_cell)
      : shape_(shape), dimension_(grid.dimension), origin_(grid.origin) {
    const Bounds3 box = shape.bounds();
    double smallest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      if (k >= dimension_) {
        cell_[k] = sub_[k] = 0;
        low_[k] = 0;
        count_[k] = per_cell_[k] = 1;
        continue;
      }
      per_cell_[k] = per_cell[k];
      cell_[k] = grid.cell[k];
      sub_[k] = cell_[k] / per_cell_[k];
      smallest = std::min(smallest, sub_[k]);
      // One cell more on each side: a bound that rounds across a grid line must not lose a row.
      const double last = grid.cells[k] - 1;
      low_[k] = static_cast<int>(std::clamp(std::floor((box.low[k] - origin_[k]) / cell_[k]) - 1, 0., last));
      const int high = static_cast<int>(std::clamp(std::floor((box.high[k] - origin_[k]) / cell_[k]) + 1, 0., last));
      count_[k] = box.low[k] <= box.high[k] ? std::max(0, high - low_[k] + 1) : 0;
      if (grid.cells[k] <= 0) count_[k] = 0;
      in_grid_ = in_grid_ && box.low[k] >= origin_[k] - boundary_tolerance * sub_[k] &&
                 box.high[k] <= origin_[k] + grid.cells[k] * cell_[k] + boundary_tolerance * sub_[k];
    }
    tolerance_ = boundary_tolerance * smallest;
    depth_ = dimension_ == 2 ? 4 : 3;
    cover_.assign(std::size_t(count_[0]) * count_[1] * count_[2], Cover::none);
    if (!cover_.empty()) classify({0, 0, 0}, count_);
  }

  int dimension() const { return dimension_; }
  bool shape_in_grid() const { return in_grid_; }
  const Index& count() const { return count_; }
  const Index& per_cell() const { return per_cell_; }
  Cover cover(std::size_t cell) const { return cover_[cell]; }
  std::size_t cell_number(const Index& c) const { return (std::size_t(c[2]) * count_[1] + c[1]) * count_[0] + c[0]; }
  std::size_t cells() const { return cover_.size(); }
  int subs_per_cell() const { return per_cell_[0] * per_cell_[1] * per_cell_[2]; }
  const Vec<3>& sub() const { return sub_; }  // edges of a sub-cell, m
  double sub_measure() const { return sub_[0] * sub_[1] * (dimension_ == 3 ? sub_[2] : 1); }

  Vec<3> centre(const Index& cell, const Index& sub) const {
    Vec<3> x;
    for (int k = 0; k < dimension_; ++k) x[k] = origin_[k] + (low_[k] + cell[k] + (sub[k] + 0.5) / per_cell_[k]) * cell_[k];
    return x;
  }
  bool contains(const Vec<3>& x) const { return shape_.contains(x, tolerance_); }
  /// Covered part of the sub-cell around x.
  Part covered(const Vec<3>& x) const {
    const CoveredPart part = covered_part(shape_, dimension_, x, sub_ * 0.5, depth_, tolerance_);
    Part whole{std::llround(part.fraction * whole_part), {}};
    for (int k = 0; k < dimension_; ++k) whole.moment[k] = std::llround(part.moment[k] / sub_[k] * whole_part);
    return whole;
  }

 private:
  // A ball around the centre of a box of cells settles the whole box where the boundary is further away than its corners.
  void classify(const Index& from, const Index& to) {
    Vec<3> middle, half;
    for (int k = 0; k < dimension_; ++k) {
      middle[k] = origin_[k] + (low_[k] + (from[k] + to[k]) * 0.5) * cell_[k];
      half[k] = (to[k] - from[k]) * 0.5 * cell_[k];
    }
    const double distance = shape_.distance(middle), reach = norm(half) + 2 * tolerance_;
    const bool single = to[0] - from[0] == 1 && to[1] - from[1] == 1 && to[2] - from[2] == 1;
    if (distance > reach) return;  // none
    if (distance < -reach || single) {
      const Cover cover = distance < -reach ? Cover::full : Cover::partial;
      Index c;
      for (c[2] = from[2]; c[2] < to[2]; ++c[2])
        for (c[1] = from[1]; c[1] < to[1]; ++c[1]) std::fill_n(cover_.begin() + cell_number({from[0], c[1], c[2]}), to[0] - from[0], cover);
      return;
    }
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (to[k] - from[k] > to[longest] - from[longest]) longest = k;
    Index lower_end = to, upper_start = from;
    lower_end[longest] = upper_start[longest] = (from[longest] + to[longest]) / 2;
    classify(from, lower_end);
    classify(upper_start, to);
  }

  const Region& shape_;
  int dimension_, depth_;
  Vec<3> origin_, cell_, sub_;
  Index low_, count_, per_cell_;
  bool in_grid_ = true;
  double tolerance_;
  std::vector<Cover> cover_;
};

// Calls visit(cell number, cell, sub) for every sub-cell of the cells that `wanted` accepts, in the order of particles.
template <class Wanted, class Visit>
void for_each_sub(const Lattice& lattice, Wanted wanted, Visit visit) {
  const Index &n = lattice.count(), &m = lattice.per_cell();
  Index c, s;
  std::size_t number = 0;
  for (c[2] = 0; c[2] < n[2]; ++c[2])
    for (c[1] = 0; c[1] < n[1]; ++c[1])
      for (c[0] = 0; c[0] < n[0]; ++c[0], ++number) {
        if (!wanted(lattice.cover(number))) continue;
        for (s[2] = 0; s[2] < m[2]; ++s[2])
          for (s[1] = 0; s[1] < m[1]; ++s[1])
            for (s[0] = 0; s[0] < m[0]; ++s[0]) visit(number, c, s);
      }
}

// Which particle sits in a sub-cell. Full cells hold theirs in order; in partial ones the few particles are searched.
class ParticleFinder {
 public:
  explicit ParticleFinder(const Lattice& lattice) : lattice_(lattice), first_(lattice.cells() + 1, 0) {}
  void add(std::size_t cell, const Index& sub) {
    sub_.push_back(sub_number(sub));
    ++first_[cell + 1];
  }
  void finish() {
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  }
  /// Particle in the sub-cell `step` sub-cells away from (cell, sub); -1 when there is none.
  std::int64_t find(Index cell, Index sub, const Index& step) const {
    for (int k = 0; k < 3; ++k) {
      sub[k] += step[k];
      const int m = lattice_.per_cell()[k];
      if (sub[k] < 0) sub[k] += m, --cell[k];
      if (sub[k] >= m) sub[k] -= m, ++cell[k];
      if (cell[k] < 0 || cell[k] >= lattice_.count()[k]) return -1;
    }
    const std::size_t number = lattice_.cell_number(cell);
    const auto begin = sub_.begin() + first_[number], end = sub_.begin() + first_[number + 1];
    const auto found = std::find(begin, end, sub_number(sub));
    return found == end ? -1 : found - sub_.begin();
  }

 private:
  int sub_number(const Index& s) const { return (s[2] * lattice_.per_cell()[1] + s[1]) * lattice_.per_cell()[0] + s[0]; }
  const Lattice& lattice_;
  std::vector<std::int64_t> first_;
  std::vector<int> sub_;
};

// Gives the part of an empty sub-cell in equal shares to the particles nearest to it; a sliver without neighbours is left to the common factor.
void share_out(const Part& part, const Lattice& lattice, const ParticleFinder& finder, const Index& cell, const Index& sub,
               std::vector<Part>& weights) {
  const int reach_z = lattice.dimension() == 3 ? 1 : 0;
  for (int axes = 1; axes <= lattice.dimension(); ++axes) {
    std::array<std::pair<std::int64_t, Index>, 12> nearest{};
    int found = 0;
    for (int k = -reach_z; k <= reach_z; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          if (std::abs(i) + std::abs(j) + std::abs(k) != axes) continue;
          const std::int64_t particle = finder.find(cell, sub, {i, j, k});
          if (particle >= 0) nearest[found++] = {particle, {i, j, k}};
        }
    for (int n = 0; n < found; ++n) {
      const auto& [particle, step] = nearest[n];
      weights[particle].measure += part.measure * (share_denominator / found);
      for (int k = 0; k < 3; ++k) weights[particle].moment[k] += (part.moment[k] - step[k] * part.measure) * (share_denominator / found);
    }
    if (found > 0) return;
  }
}

double covered_measure_of(const Lattice& lattice) {
  std::int64_t whole = 0, parts = 0;
  for (std::size_t k = 0; k < lattice.cells(); ++k)
    if (lattice.cover(k) == Cover::full) whole += lattice.subs_per_cell();
  for_each_sub(
      lattice, [](Cover c) { return c == Cover::partial; },
      [&](std::size_t, const Index& c, const Index& s) { parts += lattice.covered(lattice.centre(c, s)).measure; });
  return (static_cast<double>(whole) + static_cast<double>(parts) / whole_part) * lattice.sub_measure();
}

// Measures and places of particles follow the boundary: each becomes the middle of what it stands for.
void follow_boundary(const Region& shape, const Lattice& lattice, const ParticleFinder& finder, std::vector<FilledParticle>& particles) {
  std::vector<Part> weights(particles.size(), Part{whole_weight, {}});
  std::int64_t whole = 0, parts = 0;
  for (std::size_t k = 0; k < lattice.cells(); ++k)
    if (lattice.cover(k) == Cover::full) whole += lattice.subs_per_cell();
  const auto partial = [](Cover c) { return c == Cover::partial; };
  const auto visit_parts = [&](auto visit) {
    for_each_sub(lattice, partial, [&](std::size_t, const Index& c, const Index& s) { visit(c, s, finder.find(c, s, {0, 0, 0})); });
  };
  std::vector<Part> covered;
  visit_parts([&](const Index& c, const Index& s, std::int64_t particle) {
    const Part part = lattice.covered(lattice.centre(c, s));
    covered.push_back(part);
    parts += part.measure;
    if (particle < 0) return;
    weights[particle].measure = part.measure * share_denominator;
    for (int k = 0; k < 3; ++k) weights[particle].moment[k] = part.moment[k] * share_denominator;
  });
  std::size_t next = 0;
  visit_parts([&](const Index& c, const Index& s, std::int64_t particle) {
    const Part& part = covered[next++];
    if (particle < 0 && part.measure > 0) share_out(part, lattice, finder, c, s, weights);
  });

  const bool exact = shape.dimension() == lattice.dimension() && lattice.shape_in_grid() && shape.measure().has_value();
  const double target =
      exact ? *shape.measure() : (static_cast<double>(whole) + static_cast<double>(parts) / whole_part) * lattice.sub_measure();
  double total = 0;
  for (const Part& w : weights) total += static_cast<double>(w.measure) / whole_weight;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const auto measure = static_cast<double>(weights[p].measure);
    particles[p].measure = measure / whole_weight / total * target;
    if (measure == 0) continue;
    for (int k = 0; k < 3; ++k) {
      const double off = static_cast<double>(weights[p].moment[k]) / measure;
      particles[p].position[k] += std::clamp(off, -furthest_off, furthest_off) * lattice.sub()[k];
    }
  }
}
}  // namespace

std::vector<FilledParticle> fill_shape(const Region& shape, const FillGrid& grid, const std::array<int, 3>& per_cell, FillMeasure measure) {
  const Lattice lattice(shape, grid, per_cell);
  const double sub_measure = lattice.sub_measure();
  std::vector<FilledParticle> particles;
  ParticleFinder finder(lattice);
  for_each_sub(
      lattice, [](Cover c) { return c != Cover::none; },
      [&](std::size_t number, const Index& c, const Index& s) {
        const Vec<3> x = lattice.centre(c, s);
        if (lattice.cover(number) == Cover::partial && !lattice.contains(x) &&
            !(measure == FillMeasure::matched && lattice.covered(x).measure >= least_own_part))
          return;
        particles.push_back({x, sub_measure});
        if (measure == FillMeasure::matched) finder.add(number, s);
      });
  if (measure == FillMeasure::matched && !particles.empty()) {
    finder.finish();
    follow_boundary(shape, lattice, finder, particles);
  }
  return particles;
}

double covered_measure(const Region& shape, const FillGrid& grid, const std::array<int, 3>& per_cell) {
  return covered_measure_of(Lattice(shape, grid, per_cell));
}

}  // namespace crampon
