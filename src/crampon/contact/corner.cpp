#include "crampon/contact/corner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/contact/separation.hpp"

namespace crampon {

namespace {

/// A corner is taken for one when its faces leave a gap that is wider than the gap of one plane by this many sizes of particles. Rows of
/// particles that slant across the cells and round faces gain less, and are no corners. At a true corner one plane leaves a larger overlap,
/// even when the node sees only the outermost row of the particles.
constexpr double clear_gain = 0.6;

/// Size of the particles across n in the mean, as perpendicular_cell() has it of cells, m.
template <int Dim>
double mean_size(std::span<const OutlinedPoint<Dim>> points, const Vec<Dim>& n) {
  double sum = 0;
  for (const OutlinedPoint<Dim>& p : points) {
    double squares = 0;
    for (const Vec<Dim>& r : p.half_edges) squares += dot(n, r) * dot(n, r);
    sum += 2 * std::sqrt(squares);
  }
  return sum / static_cast<double>(points.size());
}

/// The body in the corner is convex there; the other is parted among the faces of the corner.
template <int Dim>
class CornerSearch {
 public:
  CornerSearch(std::span<const OutlinedPoint<Dim>> points, ContactSide convex, const Vec<Dim>& cell)
      : points_(points), convex_(convex), cell_(cell) {}

  /// Faces that all leave a gap of more than `wanted`, m; or none.
  std::vector<CornerFace<Dim>> run(double wanted) {
    if (!start()) return {};
    for (int count = 2; count <= Dim; ++count) {
      if (!add_face()) return {};
      for (int round = 0; round < 2; ++round) {
        for (CornerFace<Dim>& face : faces_) {
          if (!share_out()) return {};
          turn(face);
        }
      }
      if (!share_out()) return {};
      if (least_gap() > wanted) return std::move(faces_);
    }
    return {};
  }

 private:
  /// Directions in which the particles of both that lie closest to each other face: each points to the nearest of the convex body.
  bool start() {
    std::vector<Vec<Dim>> ways;
    double least = std::numeric_limits<double>::infinity();
    for (const OutlinedPoint<Dim>& p : points_) {
      if (p.side == convex_) continue;
      Vec<Dim> way;
      double nearest = std::numeric_limits<double>::infinity();
      for (const OutlinedPoint<Dim>& q : points_) {
        if (q.side == convex_ && in_cells(q.x - p.x) < nearest) way = q.x - p.x, nearest = in_cells(way);
      }
      ways.push_back(way);
      least = std::fmin(least, nearest);
    }
    // Diagonal neighbours, which face across no face, are 1.4 times as far as those in a row.
    for (const Vec<Dim>& way : ways) {
      if (in_cells(way) > 0 && in_cells(way) < 1.25 * least) directions_.push_back(normalized(way));
    }
    if (directions_.size() < 2) return false;
    // Of the two that are furthest from each other, one is furthest from the mean.
    Vec<Dim> mean;
    for (const Vec<Dim>& d : directions_) mean += d;
    faces_.push_back({furthest([&](const Vec<Dim>& d) { return dot(d, mean); }), {}});
    return true;
  }

  template <class F>
  Vec<Dim> furthest(F closeness) const {
    Vec<Dim> found;
    double least = std::numeric_limits<double>::infinity();
    for (const Vec<Dim>& d : directions_) {
      const double c = closeness(d);
      if (c < least - 1e-9) least = c, found = d;
    }
    return found;
  }

  /// That whose nearest face is furthest; not where it is all but one of them.
  bool add_face() {
    const auto closeness = [&](const Vec<Dim>& d) {
      double most = -1;
      for (const CornerFace<Dim>& face : faces_) most = std::fmax(most, dot(d, face.n));
      return most;
    };
    const Vec<Dim> n = furthest(closeness);
    if (closeness(n) > 0.94) return false;  // 20 degrees
    faces_.push_back({n, {}});
    return true;
  }

  double in_cells(Vec<Dim> way) const {
    for (int k = 0; k < Dim; ++k) way[k] /= cell_[k];
    return norm(way);
  }

  double half_width(const OutlinedPoint<Dim>& p, const Vec<Dim>& n) const {
    double half = 0;
    for (const Vec<Dim>& r : p.half_edges) half += std::fabs(dot(n, r));
    return half;
  }

  /// A particle of the notched body lies before a face when it is behind the plane of no other. False when a face has none.
  bool share_out() {
    std::vector<double> plane;  // where the convex body begins
    for (const CornerFace<Dim>& face : faces_) {
      double begin = std::numeric_limits<double>::infinity();
      for (const OutlinedPoint<Dim>& p : points_) {
        if (p.side == convex_) begin = std::fmin(begin, dot(p.x, face.n) - half_width(p, face.n));
      }
      plane.push_back(begin);
    }
    bool all_meet = true;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      faces_[f].is_before.assign(points_.size(), 1);
      bool any = false;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (points_[i].side == convex_) continue;
        for (std::size_t other = 0; other < faces_.size(); ++other) {
          if (other != f && dot(points_[i].x, faces_[other].n) < plane[other]) faces_[f].is_before[i] = 0;
        }
        any = any || faces_[f].is_before[i];
      }
      all_meet = all_meet && any;
    }
    return all_meet;
  }

  /// Turns a face to what parts its particles best, where that leaves a wider gap.
  void turn(CornerFace<Dim>& face) const {
    std::vector<LabelledPoint<Dim>> labelled;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!face.is_before[i]) continue;
      LabelledPoint<Dim> p;
      for (int k = 0; k < Dim; ++k) p.x[k] = points_[i].x[k] / cell_[k];
      p.weight = points_[i].weight;
      p.side = side_of(points_[i]);
      labelled.push_back(p);
    }
    const auto n = logistic_regression_normal<Dim>(labelled, cell_);
    if (n && gap(face.is_before, *n) > gap(face.is_before, face.n)) face.n = *n;
  }

  /// Normals point from a to b as long as the search goes on: b is the convex body.
  ContactSide side_of(const OutlinedPoint<Dim>& p) const { return p.side == convex_ ? ContactSide::b : ContactSide::a; }

  double gap(const std::vector<std::uint8_t>& is_before, const Vec<Dim>& n) const {
    RegressionGap<Dim> gap(n);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (is_before[i]) gap.add(points_[i].x, points_[i].half_edges, side_of(points_[i]));
    }
    return gap.gap();
  }

  /// The least of the gaps that faces leave.
  double least_gap() const {
    double least = std::numeric_limits<double>::infinity();
    for (const CornerFace<Dim>& face : faces_) least = std::fmin(least, gap(face.is_before, face.n));
    return least;
  }

  std::span<const OutlinedPoint<Dim>> points_;
  ContactSide convex_;
  Vec<Dim> cell_;
  std::vector<Vec<Dim>> directions_;
  std::vector<CornerFace<Dim>> faces_;  ///< normals point to the convex body
};

}  // namespace

template <int Dim>
std::vector<CornerFace<Dim>> find_corner(std::span<const OutlinedPoint<Dim>> points, const Vec<Dim>& n, const Vec<Dim>& cell) {
  RegressionGap<Dim> single(n);
  for (const OutlinedPoint<Dim>& p : points) single.add(p.x, p.half_edges, p.side);
  const double wanted = single.gap() + clear_gain * mean_size(points, n);
  if (!(wanted < 0)) return {};  // faces that touch leave nothing to gain
  for (const ContactSide convex : {ContactSide::b, ContactSide::a}) {
    std::vector<CornerFace<Dim>> faces = CornerSearch<Dim>(points, convex, cell).run(wanted);
    if (faces.empty()) continue;
    if (convex == ContactSide::a) {
      for (CornerFace<Dim>& face : faces) face.n = -face.n;
    }
    // Faces of one corner differ along a direction that favours no axis and no diagonal.
    std::sort(faces.begin(), faces.end(), [](const CornerFace<Dim>& f, const CornerFace<Dim>& g) {
      constexpr double along[] = {1, 0.618, 0.382};
      double difference = 0;
      for (int k = 0; k < Dim; ++k) difference += along[k] * (f.n[k] - g.n[k]);
      return difference < 0;
    });
    return faces;
  }
  return {};
}

template std::vector<CornerFace<2>> find_corner<2>(std::span<const OutlinedPoint<2>>, const Vec<2>&, const Vec<2>&);
template std::vector<CornerFace<3>> find_corner<3>(std::span<const OutlinedPoint<3>>, const Vec<3>&, const Vec<3>&);

}  // namespace crampon
