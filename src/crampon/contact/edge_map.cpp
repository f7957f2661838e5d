#include "crampon/contact/edge_map.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {

namespace {

/// Density of a sum of numbers, each spread evenly over (-w, w): the profile of a shape function along a direction.
class Profile {
 public:
  void add(double half_width) {
    const std::size_t before = ends_.size();
    for (std::size_t i = 0; i < before; ++i) {
      ends_.push_back({ends_[i].t - half_width, -ends_[i].sign});
      ends_[i].t += half_width;
    }
    scale_ /= 2 * half_width;
    if (++boxes_ > 1) scale_ /= boxes_ - 1;
  }
  /// Another number, w or -w.
  void add_pair(double w) {
    const std::size_t before = ends_.size();
    for (std::size_t i = 0; i < before; ++i) {
      ends_.push_back({ends_[i].t - w, ends_[i].sign});
      ends_[i].t += w;
    }
    scale_ /= 2;
  }
  double reach() const { return ends_.front().t; }
  /// Folded boxes are a sum of truncated powers.
  double at(double t) const {
    double sum = 0;
    for (const End& e : ends_) {
      const double left = e.t - std::fabs(t);
      if (left <= 0) continue;
      double power = e.sign;
      for (int k = 1; k < boxes_; ++k) power *= left;
      sum += power;
    }
    return std::fmax(0., scale_ * sum);
  }

 private:
  struct End {
    double t, sign;
  };
  std::vector<End> ends_{{0, 1}};
  int boxes_ = 0;
  double scale_ = 1;
};

/// Half the thickness of a layer of particles, in cells, that stands for a body without layers.
constexpr double continuous_half_size = 1. / 256;

}  // namespace

template <int Dim>
double perpendicular_cell(const Vec<Dim>& cell, const Vec<Dim>& n) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) sum += n[k] * cell[k] * (n[k] * cell[k]);
  return std::sqrt(sum);
}

template <int Dim>
PlaneInCells plane_in_cells(const Vec<Dim>& cell, const Vec<Dim>& n) {
  PlaneInCells plane;
  plane.h = perpendicular_cell(cell, n);
  double fourth = 0;
  for (int k = 0; k < Dim; ++k) {
    const double m = n[k] * cell[k] / plane.h;
    plane.axis[k] = m * m;
    fourth += plane.axis[k] * plane.axis[k];
  }
  plane.oblique = std::clamp(2 * (1 - fourth), 0., 1.);
  return plane;
}

EdgeMap::EdgeMap(ProfileBoxes boxes, HalfSizes half_sizes, Packing packing) {
  constexpr double along[] = {1};
  const double between[] = {std::sqrt(0.5), std::sqrt(0.5)};
  straight_.clear();
  double squares = 0;
  for (const double l : half_sizes) {
    squares += l * l;
    straight_.push_back(tabulate(boxes, along, l, packing));
  }
  if (std::all_of(half_sizes.begin(), half_sizes.end(), [&](double l) { return l == half_sizes.front(); })) straight_.resize(1);
  diagonal_ = tabulate(boxes, between, std::sqrt(squares / static_cast<double>(half_sizes.size())), packing);
}

EdgeMap::Table EdgeMap::tabulate(ProfileBoxes boxes, std::span<const double> direction, double half_size, Packing packing) {
  Profile seen, area;  // particles that end at the edge fill their own boxes: the area does without them
  for (const double m : direction) {
    for (int i = 0; i < boxes.cell; ++i) {
      seen.add(m / 2);
      area.add(m / 2);
    }
    for (int i = 0; i < boxes.particle; ++i) seen.add(m * half_size);
    for (int i = 0; i < boxes.ends; ++i) seen.add_pair(m * half_size);
  }
  const double l = packing == Packing::layers ? half_size : continuous_half_size;
  // The node sees an edge that is at least half a layer within reach. Edges between layers of undisturbed rows are on the steps.
  const double high = seen.reach() - l, step = half_size / std::ceil(100 * half_size);
  const int half_count = static_cast<int>(std::ceil(high / step - 1e-9));
  Table table;
  table.low = -high;
  table.step = high / half_count;
  table.p.clear();
  table.rest.clear();
  table.area.clear();
  for (int i = -half_count; i <= half_count; ++i) {
    const double d = i * table.step;
    double first = 0, ahead = 0, behind = 0;
    for (double r = l; r < seen.reach() + std::fabs(d); r += 2 * l) {
      ahead += seen.at(d + r);
      first += seen.at(d + r) * (d + r);
      behind += seen.at(d - r);
    }
    // At the ends: a layer of no weight, and all of them.
    table.p.push_back(i == half_count ? seen.reach() : i == -half_count ? 0. : first / ahead);
    table.rest.push_back(i == half_count ? 1. : i == -half_count ? 0. : behind / (ahead + behind));
    // Linear functions across an axis: a node does not see particles that are a cell away, and the others share its part.
    const bool blind = boxes.cell == 2 && boxes.particle == 0 && direction.size() == 1;
    table.area.push_back(i == half_count || i == -half_count ? 0.
                         : blind                             ? std::clamp((high - std::fabs(d)) / std::fmax(2 * high - 1, 1e-9), 0., 1.)
                                                             : area.at(d));
  }
  return table;
}

/// d, linear between steps and in step with the value beyond them.
double EdgeMap::Table::find(const std::vector<double>& column, double value) const {
  const double high = low + step * static_cast<double>(column.size() - 1);
  if (value <= column.front()) return low + (value - column.front());
  if (value >= column.back()) return high + (value - column.back());
  const auto above = std::upper_bound(column.begin(), column.end(), value);
  const auto i = above - column.begin();
  return low + step * (static_cast<double>(i) - (*above - value) / (*above - *(above - 1)));
}

/// Linear between steps; beyond them the value at the end.
double EdgeMap::Table::read(const std::vector<double>& column, double d) const {
  const double last = static_cast<double>(column.size() - 1), at = std::clamp((d - low) / step, 0., last);
  const std::size_t i = std::min(static_cast<std::size_t>(at), column.size() - 2);
  return column[i] + (at - static_cast<double>(i)) * (column[i + 1] - column[i]);
}

template <class F>
double EdgeMap::mix(const PlaneInCells& plane, F value) const {
  double straight = 0;
  if (straight_.size() == 1) {
    straight = value(straight_[0]);
  } else {
    for (std::size_t k = 0; k < straight_.size(); ++k) straight += plane.axis[k] * value(straight_[k]);
  }
  if (plane.oblique == 0) return straight;
  return (1 - plane.oblique) * straight + plane.oblique * value(diagonal_);
}

double EdgeMap::edge_distance(double p, const PlaneInCells& plane) const {
  return mix(plane, [p](const Table& t) { return t.find(t.p, p); });
}

double EdgeMap::area_at(double d, const PlaneInCells& plane) const {
  return mix(plane, [d](const Table& t) { return t.read(t.area, d); });
}

double EdgeMap::volume_at(double d, const PlaneInCells& plane) const {
  return 1 - mix(plane, [d](const Table& t) { return t.read(t.rest, d); });
}

template double perpendicular_cell<2>(const Vec<2>&, const Vec<2>&);
template double perpendicular_cell<3>(const Vec<3>&, const Vec<3>&);
template PlaneInCells plane_in_cells<2>(const Vec<2>&, const Vec<2>&);
template PlaneInCells plane_in_cells<3>(const Vec<3>&, const Vec<3>&);

}  // namespace crampon
