#include "crampon/contact/face_to_face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "crampon/contact/separation.hpp"

namespace crampon {

namespace {

/// A rigid face holds nodes that lie less deep in the material than this, in cells. Shape functions of three nodes see the face from
/// further away too. But if the face held two rows of nodes, the first row of cells could not deform. The second row of nodes of a body
/// that is aligned with the grid lies at a depth of exactly one cell. The limit is less than one so that errors of positions do not decide
/// about it.
constexpr double deepest_held = 0.99;

/// The weight of a particle in regressions is the root of S_ip. It goes to zero where the node's reach ends, so that a particle comes in
/// and leaves without a jump. uGIMP particles, two per cell, lie exactly at that end. With a jump, a tremor of such a particle turned the
/// normal by some degrees, and the turned normal kept the body trembling. S_ip is a product of one factor for each axis, and so is its
/// root. The weights of two rows of particles along a face therefore differ by a common factor only, which does not tilt the normal.
template <int Dim>
double regression_weight(const CloudPoint<Dim>& point) {
  return std::sqrt(point.S);
}

/// f(point, side) for the particles of both faces about a node.
template <int Dim, class F>
void for_points(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b, F f) {
  for (const CloudPoint<Dim>& point : *place.points) {
    if (a.groups & point.group) f(point, ContactSide::a);
    if (b.groups & point.group) f(point, ContactSide::b);
  }
}

/// x_b - x_a in the mean, and the same at the start.
template <int Dim>
Vec<Dim> apart(const Face<Dim>& a, const Face<Dim>& b) {
  return b.x * (1 / b.m) - a.x * (1 / a.m);
}
template <int Dim>
Vec<Dim> apart_at_start(const Face<Dim>& a, const Face<Dim>& b) {
  return b.X * (1 / b.m) - a.X * (1 / a.m);
}

}  // namespace

template <int Dim>
FaceToFace<Dim>::FaceToFace(const ContactModel<Dim>& contact, const Grid<Dim>& grid, const ContactMemory& memory)
    : contact_(contact), grid_(grid), memory_(memory) {}

template <int Dim>
bool FaceToFace<Dim>::see_material(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b, const Face<Dim>& facing,
                                   ContactPair<Dim>& pair) {
  Vec<Dim> n = contact_.normal_between(a.field, facing.field);
  if (n == Vec<Dim>{}) n = found_normal(place, a, facing);
  pair.n = normalized(place.mirrors.mean(n));
  if (pair.n == Vec<Dim>{}) return false;
  const PlaneInCells plane = plane_in_cells(grid_.cell, pair.n);
  double depth = 0;  // of the node before a rigid face, in cells
  if (b.rigid) depth = contact_.fields[b.field].edge.edge_distance(dot(b.x, pair.n) / (b.m * plane.h), plane);
  if (depth >= deepest_held && contact_.scheme != ContactScheme::literal) return false;
  pair.volume_ratio = relative_volume(place);
  pair.gap = gap(contact_.material_detection, place, a, b, pair, pair.n);
  if (pair.law->needs_area())
    pair.area = (b.rigid ? area_on_rigid(a, b, depth, pair.n, plane) : area_between(a, b, pair.n)) / place.mirrors.images;
  recall_history(place, a, b, pair);
  return true;
}

template <int Dim>
void FaceToFace<Dim>::part_corner(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b,
                                  std::vector<ContactPair<Dim>>& pairs) {
  const ContactPair<Dim> whole = pairs.back();
  const bool by_regression = contact_.normal == ContactNormal::logistic_regression || contact_.normal == ContactNormal::linear_regression;
  const bool given = contact_.normal_between(a.field, b.field) != Vec<Dim>{};
  const ContactDetection detection = contact_.material_detection;
  // Where particles were at the start is known of all of a body alone.
  const bool looks_back = whole.law->has_springs() || detection == ContactDetection::displacement;
  if (!by_regression || given || a.rigid || b.rigid || looks_back) return;
  corner_points_.clear();
  for_points(place, a, b, [&](const CloudPoint<Dim>& point, ContactSide side) {
    corner_points_.push_back({point.x, point.half_edges(), regression_weight(point), side});
  });
  const std::vector<CornerFace<Dim>> faces = find_corner<Dim>(corner_points_, whole.n, grid_.cell);
  if (faces.empty()) return;
  pairs.pop_back();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    ContactPair<Dim> pair = whole;
    pair.name.face = static_cast<std::uint8_t>(f + 1);
    pair.n = normalized(place.mirrors.mean(faces[f].n));
    if (pair.n == Vec<Dim>{}) continue;
    const auto [part_of_a, part_of_b] = before(place, a, b, faces[f]);
    if (detection == ContactDetection::regression) {
      RegressionGap<Dim> outlines(pair.n);
      for (std::size_t i = 0; i < corner_points_.size(); ++i) {
        if (faces[f].is_before[i]) outlines.add(corner_points_[i].x, corner_points_[i].half_edges, corner_points_[i].side);
      }
      pair.gap = outlines.gap();
    } else {
      pair.gap = gap(detection, place, part_of_a, part_of_b, pair, pair.n);
    }
    if (pair.law->needs_area()) pair.area = area_between(part_of_a, part_of_b, pair.n) / place.mirrors.images;
    pairs.push_back(pair);
  }
}

/// The parts of a and b that lie before one face of a corner.
template <int Dim>
std::pair<Face<Dim>, Face<Dim>> FaceToFace<Dim>::before(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b,
                                                        const CornerFace<Dim>& face) const {
  std::pair<Face<Dim>, Face<Dim>> parts{a, b};
  for (Face<Dim>* part : {&parts.first, &parts.second}) part->m = 0, part->x = {};
  std::size_t i = 0;
  for_points(place, a, b, [&](const CloudPoint<Dim>& point, ContactSide side) {
    if (!face.is_before[i++]) return;
    Face<Dim>& part = side == ContactSide::a ? parts.first : parts.second;
    part.m += point.m;
    part.x += point.x * point.m;
  });
  parts.first.volume *= parts.first.m / a.m;
  parts.second.volume *= parts.second.m / b.m;
  return parts;
}

/// What the law asks of the past: on the side of the lower field, above a crack (docs/theory/contact.md, which law).
template <int Dim>
void FaceToFace<Dim>::recall_history(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b, ContactPair<Dim>& pair) const {
  if (pair.law->needs_history()) pair.history = a.history / a.m;
  if (!pair.law->has_springs()) return;
  // Of what lies between the mean positions, the strain and the turn of both sides are not opening.
  const Vec<Dim> start = apart_at_start(a, b);
  Vec<Dim> deformed;
  for_points(place, a, b, [&](const CloudPoint<Dim>& point, ContactSide side) {
    const double share = 0.5 * point.m / (side == ContactSide::a ? a.m : b.m);
    for (int k = 0; k < Dim; ++k) deformed += point.F[k] * (share * start[k]);
  });
  pair.opening = apart(a, b) - deformed;
  pair.gap = dot(pair.opening, pair.n);  // an interface is closed at the start
}

template <int Dim>
bool FaceToFace<Dim>::see_across(const MeetingPlace<Dim>& place, const CrackAtNode<Dim>& crack, const Face<Dim>& a, const Face<Dim>& b,
                                 ContactPair<Dim>& pair) {
  if (crack.side == 0 || crack.n == Vec<Dim>{}) return false;
  pair.n = crack.n;
  pair.volume_ratio = relative_volume(place);
  pair.gap = gap(contact_.detection, place, a, b, pair, crack.N);
  if (pair.law->needs_area()) pair.area = area_between(a, b, pair.n) / place.mirrors.images;
  recall_history(place, a, b, pair);
  return true;
}

template <int Dim>
double FaceToFace<Dim>::cell_volume() const {
  double volume = 1;
  for (int k = 0; k < Dim; ++k) volume *= grid_.cell[k];
  return volume;
}

template <int Dim>
double FaceToFace<Dim>::thickness(const Face<Dim>& a, const Face<Dim>& b) const {
  return std::fmin(contact_.fields[a.field].thickness, contact_.fields[b.field].thickness);
}

template <int Dim>
double FaceToFace<Dim>::area_between(const Face<Dim>& a, const Face<Dim>& b, const Vec<Dim>& n) const {
  return contact_area(a.volume, dot(a.x, n) / a.m, contact_.fields[a.field].edge, b.volume, dot(b.x, n) / b.m,
                      contact_.fields[b.field].edge, plane_in_cells(grid_.cell, n)) *
         thickness(a, b);
}

/// A rigid face is as wide as the material's edge; beside the material's end only the part of the node that it fills counts. Nodes too deep
/// inside to be held hand their parts to the row before them.
template <int Dim>
double FaceToFace<Dim>::area_on_rigid(const Face<Dim>& a, const Face<Dim>& b, double depth, const Vec<Dim>& n,
                                      const PlaneInCells& plane) const {
  const EdgeMap& edge = contact_.fields[a.field].edge;
  const double d = edge.edge_distance(-dot(a.x, n) / (a.m * plane.h), plane);
  const double seen = edge.volume_at(d, plane) * cell_volume();
  const double filled = seen > 0 ? std::fmin(a.volume / seen, 1.) : 0.;
  const double part = edge.area_at(d, plane) + (depth >= 0 ? edge.area_at(d - 1, plane) : 0.);
  return part * filled * cell_volume() / plane.h * thickness(a, b);
}

/// In long cells a node sees of an oblique face a piece whose mean position depends on where along the face that piece lies: beside the
/// face's end by up to a whole cell. There the outlines of the particles tell, along the normal, which is uncertain at the ends, and
/// along others.
template <int Dim>
double FaceToFace<Dim>::gap_of_outlines(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b, const Vec<Dim>& n) {
  outlined_.clear();
  for_points(place, a, b, [&](const CloudPoint<Dim>& point, ContactSide side) {
    outlined_.push_back({point.x, point.half_edges(), point.m, side, point.to_surface});
  });
  const Vec<Dim> directions[] = {n, a.g, b.g};
  return outline_gap<Dim>(outlined_, directions);
}

template <int Dim>
double FaceToFace<Dim>::relative_volume(const MeetingPlace<Dim>& place) const {
  double reference = cell_volume();
  if (contact_.reference_volume == ReferenceVolume::initial && !memory_.initial_volume.empty()) {
    const auto initial = memory_.initial_volume.find(place.number);
    if (initial != memory_.initial_volume.end() && initial->second > 0) reference = initial->second * place.mirrors.images;
  }
  return place.volume / reference;
}

/// The consistent scheme needs a gap, but a relative volume gives no distance. Below V_sep the gap counts as infinitely wide, from V_sep on
/// as closed.
template <int Dim>
double FaceToFace<Dim>::gap_by_volume(double volume_ratio) const {
  return volume_ratio < contact_.volume_separated ? std::numeric_limits<double>::max() : 0.;
}

template <int Dim>
double FaceToFace<Dim>::gap(ContactDetection detection, const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b,
                            const ContactPair<Dim>& pair, const Vec<Dim>& original_normal) {
  switch (detection) {
    case ContactDetection::position: {
      const PlaneInCells plane = plane_in_cells(grid_.cell, pair.n);
      if (contact_.position_cutoff) return dot(apart(a, b), pair.n) - *contact_.position_cutoff * plane.h;
      if (!grid_.has_even_cells() && !a.rigid && !b.rigid) return gap_of_outlines(place, a, b, pair.n);
      return position_gap(dot(a.x, pair.n) / a.m, contact_.fields[a.field].edge, dot(b.x, pair.n) / b.m, contact_.fields[b.field].edge,
                          plane);
    }
    case ContactDetection::regression: {
      RegressionGap<Dim> gap(pair.n);
      for_points(place, a, b, [&](const CloudPoint<Dim>& point, ContactSide side) { gap.add(point.x, point.half_edges(), side); });
      return gap.gap();
    }
    case ContactDetection::displacement:  // zero for closed, undeformed faces at any place and turn
      return dot(apart(a, b), pair.n) - dot(apart_at_start(a, b), original_normal);
    case ContactDetection::volume:
      break;
  }
  return gap_by_volume(pair.volume_ratio);
}

/// The plane that parts the particles of two sets of groups best.
template <int Dim>
std::optional<Vec<Dim>> FaceToFace<Dim>::regress(const MeetingPlace<Dim>& place, GroupSet a, GroupSet b) {
  labelled_.clear();
  for (const CloudPoint<Dim>& point : *place.points) {
    if (!((a | b) & point.group)) continue;
    LabelledPoint<Dim> labelled;
    for (int k = 0; k < Dim; ++k) labelled.x[k] = point.x[k] * grid_.inverse_cell[k];
    labelled.side = a & point.group ? ContactSide::a : ContactSide::b;
    labelled.weight = regression_weight(point);
    labelled_.push_back(labelled);
  }
  return contact_.normal == ContactNormal::logistic_regression ? logistic_regression_normal<Dim>(labelled_, grid_.cell)
                                                               : linear_regression_normal<Dim>(labelled_, grid_.cell);
}

/// Do a and b fill what the node sees between them? Then their outlines are each other's, and their gradients add up to nothing.
template <int Dim>
bool FaceToFace<Dim>::are_alone(const Face<Dim>& a, const Face<Dim>& b) const {
  const bool third_body = (a.company & ~(a.groups | b.groups)) != 0;
  return !third_body && norm(a.g + b.g) < 0.1 * std::fmax(norm(a.g), norm(b.g));
}

/// With a third body or empty space at hand, neither the outline of a body nor the plane between the two need be the face between them: at
/// the corner of four blocks each shows two faces, and beside the end of a block on a long floor, or on a third, that plane slants. Of all
/// that may be right, that which leaves the widest gap between the particles of both; the first of those about as good.
template <int Dim>
Vec<Dim> FaceToFace<Dim>::normal_among_others(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b) {
  const GroupSet others = a.company & ~(a.groups | b.groups);
  // Beside empty space the plane between both is good but for a few degrees, and outlines of rows of particles that slant are rough.
  const double clearly_wider = others ? 1e-6 : 0.03;  // cells
  Vec<Dim> best;
  double widest = -std::numeric_limits<double>::infinity();
  const auto try_normal = [&](const Vec<Dim>& n) {
    if (n == Vec<Dim>{}) return;
    RegressionGap<Dim> gap(n);
    for_points(place, a, b, [&](const CloudPoint<Dim>& point, ContactSide side) { gap.add(point.x, point.half_edges(), side); });
    if (gap.gap() > widest + clearly_wider * grid_.smallest_cell()) widest = gap.gap(), best = n;
  };
  try_normal(regress(place, a.groups, b.groups).value_or(Vec<Dim>{}));
  if (others) {
    try_normal(regress(place, a.groups, a.company & ~a.groups).value_or(Vec<Dim>{}));
    try_normal(regress(place, b.company & ~b.groups, b.groups).value_or(Vec<Dim>{}));
  }
  try_normal(
      gradient_normal<Dim>(GradientNormal::largest_gradient, {a.g, a.volume, a.rigid}, {b.g, b.volume, b.rigid}, contact_.rigid_bias));
  try_normal(normalized(a.g));
  try_normal(normalized(-b.g));
  try_normal(normalized(a.g * b.volume - b.g * a.volume));  // how the part of a in both changes: without the outline they have in common
  return best;
}

template <int Dim>
Vec<Dim> FaceToFace<Dim>::found_normal(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b) {
  GradientNormal gradient = GradientNormal::largest_gradient;
  const VolumeGradient<Dim> of_a{a.g, a.volume, a.rigid}, of_b{b.g, b.volume, b.rigid};
  // A rigid body shows its own surface better than any regression over both, as in gradient_normal (conventions 33).
  if (b.rigid && norm(b.g) >= norm(a.g) / contact_.rigid_bias) return normalized(-b.g);
  switch (contact_.normal) {
    case ContactNormal::logistic_regression:
    case ContactNormal::linear_regression: {
      if (!are_alone(a, b)) return normal_among_others(place, a, b);
      if (const auto n = regress(place, a.groups, b.groups)) return *n;
      break;  // too few particles: there a gradient is better than the linear regression
    }
    case ContactNormal::average_gradient:
      gradient = GradientNormal::average;
      break;
    case ContactNormal::more_volume:
      gradient = GradientNormal::more_volume;
      break;
    case ContactNormal::largest_gradient:
      break;
  }
  return gradient_normal<Dim>(gradient, of_a, of_b, contact_.rigid_bias);
}

template class FaceToFace<2>;
template class FaceToFace<3>;

}  // namespace crampon
