#include "crampon/step/find_face_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "crampon/contact/friction.hpp"
#include "crampon/geometry/way_out.hpp"
#include "crampon/step/contact_cloud.hpp"
#include "crampon/step/contact_groups.hpp"
#include "crampon/step/face_to_face.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/rigid_faces.hpp"

namespace crampon {

namespace {

/// Normals that differ by less than this (cosine) are those of one face.
constexpr double of_one_face = 0.9;

/// Does x see an edge or a corner of the body, or a side that curves as sharply: does the normal turn with x as about a point of the surface? Or
/// does the surface end before the point of it that x takes for the nearest? (Distances of combined shapes may be those of a part's face that
/// another part has cut away.)
template <int Dim>
bool sees_edge(const RigidBody<Dim>& body, const RigidPose<Dim>& pose, const Vec<Dim>& x, const RigidFaceView<Dim>& view, double cell) {
  if (std::fabs(distance_from(body, pose, x - view.out * view.distance)) > 1e-6 * cell) return true;
  if (view.distance < 1e-6 * cell) return false;
  const double step = 1e-3 * std::fmin(view.distance, cell);
  for (int k = 0; k < Dim; ++k) {
    Vec<Dim> along;
    along[k] = 1;
    along -= view.out * dot(along, view.out);
    if (norm(along) < 0.5) continue;
    along = normalized(along);
    const Vec<Dim> turned = see_face(body, pose, x + along * step).out - view.out;
    if (norm(turned) * view.distance > 0.5 * step) return true;
  }
  return false;
}

/// Where the surface of its body is before a particle.
template <int Dim>
class Surface {
 public:
  Surface(const State<Dim>& state, const Model<Dim>& model) : state_(state), model_(model) {}

  /// From the middle of a particle to the nearest point of its body's surface now, m, as the particle's deformation carries it; zero: the
  /// particle lies deep in its body.
  Vec<Dim> nearest(const CloudPoint<Dim>& point) const {
    const Vec<Dim>& surface = model_.surface[state_.particles.id[point.particle]];
    const std::array<Vec<Dim>, Dim> F = deformation(point);
    Vec<Dim> now;
    for (int k = 0; k < Dim; ++k) now += F[k] * surface[k];
    return now;
  }

  /// The way along n to the surface, m, where another side of the body is nearer; none within a cell and a half.
  std::optional<double> along(const CloudPoint<Dim>& point, const Vec<Dim>& n) const {
    const std::array<Vec<Dim>, Dim> F = deformation(point);
    Vec<Dim> line, stretched;
    for (int k = 0; k < Dim; ++k) line[k] = dot(F[k], n);
    line = normalized(line);
    Vec<3> from, to;
    for (int k = 0; k < Dim; ++k) {
      stretched += F[k] * line[k];
      from[static_cast<std::size_t>(k)] = state_.particles.original[point.particle][k];
      to[static_cast<std::size_t>(k)] = line[k];
    }
    const double cell = model_.grid.smallest_cell();
    const auto way = way_out(*model_.shapes[state_.particles.body[point.particle]], from, to, 1.5 * cell, 1e-9 * cell);
    if (!way) return std::nullopt;
    return *way * norm(stretched);
  }

 private:
  /// Columns of the deformation gradient since the start.
  std::array<Vec<Dim>, Dim> deformation(const CloudPoint<Dim>& point) const {
    if (model_.undeformed.empty()) return point.F;
    const std::array<Vec<Dim>, Dim>& back = model_.undeformed[state_.particles.id[point.particle]];
    std::array<Vec<Dim>, Dim> F{};
    for (int k = 0; k < Dim; ++k) {
      for (int j = 0; j < Dim; ++j) F[k] += point.F[j] * back[k][j];
    }
    return F;
  }

  const State<Dim>& state_;
  const Model<Dim>& model_;
};

template <int Dim, class Shape>
class FaceFinder {
 public:
  FaceFinder(State<Dim>& state, const Model<Dim>& model, std::size_t b)
      : state_(state), model_(model), b_(b), layers_(state.nodes.layers[b]), out_(state.scratch[b].face_nodes) {
    half_size_.resize(model.fields.size(), 0.);
    for (const Material<Dim>& material : model.materials) {
      for (int k = 0; k < Dim; ++k) half_size_[material.field] = std::fmax(half_size_[material.field], material.half_size[k]);
    }
  }

  void run() {
    for (int node = 0; node < block_nodes<Dim>; ++node) {
      if (layers_.shared[static_cast<std::size_t>(node)] != 0) find_groups_of(node);
    }
    if (!out_.parts.empty()) sample();
  }

 private:
  Vec<Dim> position_of(int node) const { return model_.grid.node_position(state_.blocks.list[b_].node(node)); }

  void find_groups_of(int node) {
    near_.clear();
    const Vec<Dim> x = position_of(node);
    for (std::size_t r = 0; r < model_.rigid_bodies.size(); ++r) {
      const RigidBody<Dim>& body = model_.rigid_bodies[r];
      if (body.acts == RigidBody<Dim>::Acts::face && distance_from(body, state_.rigid[r].start, x) < longest_reach(model_))
        near_.push_back(r);
    }
    if (near_.empty()) return;
    present_.clear();
    for (std::size_t l = 0; l < layers_.node.size(); ++l) {
      if (state_.nodes.momentum[layers_.slot(l, node)][Dim] > 0 && !model_.is_rigid(layers_.node[l].field))
        present_.push_back(static_cast<int>(l));
    }
    if (present_.empty()) return;
    const int groups = find_groups(layers_, model_, present_, group_of_);
    for (int g = 0; g < groups; ++g) meet_faces(node, x, g);
  }

  /// A group of a node against all rigid faces near it.
  void meet_faces(int node, const Vec<Dim>& x, int g) {
    const std::int64_t number = model_.grid.node_number(state_.blocks.list[b_].node(node));
    const Mirrors mirrors = mirrors_at(model_, number);
    FaceGroup<Dim> group;
    group.block = static_cast<std::uint32_t>(b_);
    group.node = static_cast<std::uint16_t>(node);
    group.x = x;
    group.first_slot = static_cast<std::uint32_t>(out_.slots.size());
    FacePart<Dim> part;
    part.known_as = 0xffff;
    part.mirror_axes = mirrors.axes;
    Vec<Dim> mean;
    double most = -1;
    for (std::size_t i = 0; i < present_.size(); ++i) {
      if (group_of_[i] != g) continue;
      const Layer& layer = layers_.node[static_cast<std::size_t>(present_[i])];
      const std::size_t slot = layers_.slot(present_[i], node);
      const ContactSums<Dim>& sums = state_.nodes.contact[slot];
      out_.slots.push_back(slot);
      group.m += state_.nodes.momentum[slot][Dim];
      mean += sums.present();
      part.gradient += sums.gradient();
      part.history += sums.history();
      part.known_as = std::min(part.known_as, model_.fields[layer.field].bonded_to);
      part.cracks = without_joined(layer.cracks, model_);
      if (sums.volume() > most) most = sums.volume(), part.field = layer.field;
    }
    group.end_slot = static_cast<std::uint32_t>(out_.slots.size());
    group.contact_group = find_contact_group(node, out_.slots[group.first_slot]);
    mean = mirrors.mean(mean * (1 / group.m));
    part.group = static_cast<std::uint32_t>(out_.groups.size());
    bool any = false;
    for (const std::size_t r : near_) {
      const RigidBody<Dim>& body = model_.rigid_bodies[r];
      if (std::holds_alternative<NoContact>(model_.law_between(part.field, body.field))) continue;
      const RigidFaceView<Dim> view = see_face(body, state_.rigid[r].start, x + mean);
      const Vec<Dim> n = normalized(mirrors.mean(-view.out));
      if (n == Vec<Dim>{}) continue;
      // Deeper in the material than the reach of its sums, and the face is nothing to the node. Particles may end half their size before
      // the face.
      const double depth = view.distance + dot(mean, n);
      const double reach = reach_of_sums(model_.shape_functions) + half_size_[part.field];
      if (depth > reach_across(model_.grid, reach, n) * (1 - 1e-9)) continue;
      part.body = static_cast<std::uint16_t>(r);
      part.axis = 0;
      for (int k = 1; k < Dim; ++k) {
        if (std::fabs(n[k]) > std::fabs(n[part.axis]) * (1 + 1e-9)) part.axis = static_cast<std::uint8_t>(k);
      }
      part.up = n[part.axis] > 0;
      auto at = state_.blocks.list[b_].node(node);
      part.row = at[part.axis];
      at[part.axis] = 0;
      part.column = model_.grid.node_number(at);
      out_.parts.push_back(part);
      any = true;
    }
    if (any) {
      out_.groups.push_back(group);
    } else {
      out_.slots.resize(group.first_slot);
    }
  }

  /// The group among those of a node with several fields.
  int find_contact_group(int node, std::size_t slot) const {
    const ContactNodes<Dim>& contacts = state_.scratch[b_].contact;
    const auto at = std::lower_bound(contacts.nodes.begin(), contacts.nodes.end(), node,
                                     [](const ContactNode<Dim>& c, int n) { return static_cast<int>(c.node) < n; });
    if (at == contacts.nodes.end() || static_cast<int>(at->node) != node) return -1;
    for (std::uint32_t f = at->first_field; f < at->end_field; ++f) {
      if (layers_.slot(contacts.fields[f].layer, node) == slot) return static_cast<int>(at->first_group) + contacts.fields[f].group;
    }
    return -1;
  }

  /// The particles about each part, and how far their body's surface is from the face.
  void sample() {
    static thread_local ContactCloud<Dim> cloud;
    cloud.clear();
    std::vector<bool> wanted(block_nodes<Dim>, false);
    for (const FaceGroup<Dim>& group : out_.groups) wanted[group.node] = true;
    cloud.template collect<Shape>(state_, model_, b_, wanted, ContactCloud<Dim>::Of::surface);
    for (FacePart<Dim>& part : out_.parts) {
      const FaceGroup<Dim>& group = out_.groups[part.group];
      points_.clear();
      for (const CloudPoint<Dim>& point : cloud.at(group.node)) {
        const auto begin = out_.slots.begin() + group.first_slot, end = out_.slots.begin() + group.end_slot;
        if (std::find(begin, end, layers_.slot(point.layer, static_cast<int>(group.node))) != end) points_.push_back(point);
      }
      const bool unknown = std::any_of(points_.begin(), points_.end(), [&](const CloudPoint<Dim>& point) {
        return std::isnan(model_.surface[state_.particles.id[point.particle]][0]);
      });
      part.first_sample = static_cast<std::uint32_t>(out_.samples.size());
      if (unknown && has_even_cells(model_.grid)) {
        sample_sums(group, part);
      } else {
        sample_particles(part);
      }
      part.end_sample = static_cast<std::uint32_t>(out_.samples.size());
    }
  }

  void sample_particles(const FacePart<Dim>& part) {
    const Surface<Dim> surface(state_, model_);
    for (CloudPoint<Dim> point : points_) {
      const std::uint8_t mirrored = point.mirrored;
      for (int k = 0; k < Dim; ++k) {  // itself, not its image
        if (mirrored >> k & 1u) point.mirror_deformation(k);
      }
      const Vec<Dim> x = state_.particles.position(point.particle);
      std::optional<FaceSample<Dim>> sample;
      const Vec<Dim> to_surface = surface.nearest(point);
      if (std::isnan(to_surface[0])) {  // nobody knows: the particle's own outline
        const RigidFaceView<Dim> view = see(part, x);
        double half = 0;
        for (const Vec<Dim>& r : point.half_edges()) half += std::fabs(dot(view.out, r));
        sample = FaceSample<Dim>{0, view.distance - half, -view.out, false};
      } else if (to_surface != Vec<Dim>{}) {
        sample = before_face(part, x, to_surface, [&](const Vec<Dim>& n) { return surface.along(point, n); });
      }
      if (!sample || sample->n == Vec<Dim>{}) continue;
      sample->S = point.S;
      for (int k = 0; k < Dim; ++k) {
        if (mirrored >> k & 1u) sample->n[k] = -sample->n[k];
      }
      out_.samples.push_back(*sample);
    }
  }

  /// Where nobody knows the surface of the particles' body, their mean position tells of its edge, as between bodies
  /// (docs/theory/contact.md, detection): smoother than their outlines.
  void sample_sums(const FaceGroup<Dim>& group, const FacePart<Dim>& part) {
    Vec<Dim> mean;
    for (std::uint32_t s = group.first_slot; s < group.end_slot; ++s) mean += state_.nodes.contact[out_.slots[s]].present();
    mean = mean * (1 / group.m);
    const auto to_edge = [&](const Vec<Dim>& n) {
      const PlaneInCells plane = plane_in_cells(model_.grid.cell, n);
      return -model_.fields[part.field].edge.edge_distance(-dot(mean, n) / plane.h, plane) * plane.h - dot(mean, n);
    };
    const Vec<Dim> out_of_material = normalized(part.gradient);
    if (out_of_material == Vec<Dim>{}) return;
    auto sample = before_face(part, group.x + mean, out_of_material * to_edge(out_of_material),
                              [&](const Vec<Dim>& n) { return std::optional(to_edge(n)); });
    if (!sample) return;
    // Near the end of a body's side its gradient leans, and the way along it is not the way along n.
    if (!sample->edge) sample->gap = see(part, group.x + mean).distance - to_edge(sample->n);
    sample->S = dot(part.gradient, sample->n);
    if (sample->S > 0) out_.samples.push_back(*sample);
  }

  RigidFaceView<Dim> see(const FacePart<Dim>& part, const Vec<Dim>& x) const {
    return see_face(model_.rigid_bodies[part.body], state_.rigid[part.body].start, x);
  }

  /// How the surface of a body, which is at x + to_surface, faces the rigid one. Edges of either: where the rigid body shows an edge, it is the
  /// surface of the other that tells the normal, and the distance is that of its point; where the other does, the way along the normal of
  /// the rigid body counts.
  template <class Along>
  std::optional<FaceSample<Dim>> before_face(const FacePart<Dim>& part, const Vec<Dim>& x, const Vec<Dim>& to_surface, Along along) const {
    const RigidFaceView<Dim> view = see(part, x);
    if (view.out == Vec<Dim>{}) return std::nullopt;
    const Vec<Dim> n = -view.out;
    const double depth = dot(to_surface, n);
    const bool facing = depth > of_one_face * norm(to_surface);
    const RigidBody<Dim>& body = model_.rigid_bodies[part.body];
    if (sees_edge(body, state_.rigid[part.body].start, x, view, model_.grid.smallest_cell()))
      return FaceSample<Dim>{0, see(part, x + to_surface).distance, normalized(to_surface), true};
    if (facing) return FaceSample<Dim>{0, view.distance - depth, n, false};
    const auto way = along(n);
    if (!way) return std::nullopt;
    return FaceSample<Dim>{0, view.distance - *way, n, false};
  }

  State<Dim>& state_;
  const Model<Dim>& model_;
  std::size_t b_;
  const BlockLayers<Dim>& layers_;
  FaceNodes<Dim>& out_;
  std::vector<std::size_t> near_;
  std::vector<int> present_, group_of_;
  std::vector<CloudPoint<Dim>> points_;  ///< about the part at hand
  std::vector<double> half_size_;        ///< by field: of its particles, the longest side, cells
};

/// Columns from parts that lie beside each other in one list.
template <int Dim>
class ColumnLinker {
 public:
  using PartAt = typename FaceContacts<Dim>::PartAt;

  ColumnLinker(State<Dim>& state, const Model<Dim>& model) : state_(state), model_(model), out_(state.face_contacts) {}

  void run() {
    out_.parts.clear();
    out_.columns.clear();
    out_.first_column.clear();
    std::vector<PartAt> all;
    for (std::uint32_t b = 0; b < state_.scratch.size(); ++b) {
      for (std::uint32_t p = 0; p < state_.scratch[b].face_nodes.parts.size(); ++p) all.push_back({b, p});
    }
    const auto name = [&](const PartAt& at) {
      const FacePart<Dim>& p = part(at);
      return std::tie(p.body, p.known_as, p.cracks, p.axis, p.up, p.column);
    };
    std::stable_sort(all.begin(), all.end(), [&](const PartAt& a, const PartAt& b) {
      const auto of_a = name(a), of_b = name(b);
      return of_a != of_b ? of_a < of_b : part(a).row < part(b).row;
    });
    for (std::size_t first = 0; first < all.size();) {
      // Rows that follow each other; a gap ends a face, and another of the same body begins.
      std::size_t end = first + 1;
      while (end < all.size() && name(all[end]) == name(all[first]) && part(all[end]).row == part(all[end - 1]).row + 1) ++end;
      const bool goes_on = first > 0 && name(all[first]) == name(all[first - 1]);
      face_ = goes_on ? static_cast<std::uint8_t>(face_ + 1) : std::uint8_t{0};
      add_column(all.data() + first, all.data() + end);
      first = end;
    }
    sort_by_sets();
  }

 private:
  FacePart<Dim>& part(const PartAt& at) { return state_.scratch[at.block].face_nodes.parts[at.part]; }
  FaceGroup<Dim>& group(const PartAt& at) { return state_.scratch[at.block].face_nodes.groups[part(at).group]; }

  void add_column(const PartAt* begin, const PartAt* end) {
    const FacePart<Dim>& first = part(*begin);
    ContactColumn<Dim> column;
    column.body = first.body;
    column.name = -1 - (first.column * Dim + first.axis);
    ContactPair<Dim>& pair = column.pair;
    const auto view = look(begin, end, pair);
    if (!view) return;
    column.first = static_cast<std::uint32_t>(out_.parts.size());
    double history = 0, m = 0;
    double sum = 0, size = 0;
    for (const PartAt* at = begin; at != end; ++at) {
      FacePart<Dim>& p = part(*at);
      p.w = dot(p.gradient, pair.n);
      sum += p.w;
      size += std::fabs(p.w);
    }
    // Where volumes of particles differ, a node may have less than nothing of the face; not of a sliver of it.
    const bool signed_parts = sum > 0.25 * size;
    for (const PartAt* at = begin; at != end; ++at) {
      FacePart<Dim>& p = part(*at);
      if (!signed_parts) p.w = std::fmax(p.w, 0.);
      if (p.w == 0) continue;
      column.w += p.w;
      history += p.history;
      m += group(*at).m;
      out_.parts.push_back(*at);
    }
    column.end = static_cast<std::uint32_t>(out_.parts.size());
    if (column.first == column.end) return;
    const std::uint16_t rigid = model_.rigid_bodies[first.body].field;
    pair.law = &model_.law_between(first.field, rigid);
    pair.by_gap = true;
    pair.area = column.w * model_.fields[first.field].thickness;
    if (needs_history(*pair.law)) pair.history = history / m;
    pair.name.field_a = first.known_as;
    pair.name.field_b = rigid;
    pair.name.others = first.cracks;
    pair.name.face = static_cast<std::uint8_t>(2 * face_ + (first.up ? 1 : 0));
    pair.previous = state_.memory.find({column.name, pair.name});
    if (state_.step == 0 && std::holds_alternative<AdhesiveContact>(*pair.law) && pair.gap <= 0.1 * model_.grid.smallest_cell())
      pair.previous = ContactState::stick;  // glued from the start
    out_.columns.push_back(column);
  }

  /// Normal and gap of a column: those of the particles nearest to the face, the nearer the more. Particles before an edge of the rigid body
  /// tell where none is before a face. False where most lie beyond the end of the face.
  bool look(const PartAt* begin, const PartAt* end, ContactPair<Dim>& pair) {
    const auto for_samples = [&](auto f) {
      for (const PartAt* at = begin; at != end; ++at) {
        const FaceNodes<Dim>& nodes = state_.scratch[at->block].face_nodes;
        const FacePart<Dim>& p = nodes.parts[at->part];
        for (std::uint32_t s = p.first_sample; s < p.end_sample; ++s) f(nodes.samples[s]);
      }
    };
    double least[2] = {HUGE_VAL, HUGE_VAL};  // before faces, before edges
    for_samples([&](const FaceSample<Dim>& s) { least[s.edge] = std::fmin(least[s.edge], s.gap); });
    const double near = 0.25 * model_.grid.smallest_cell();
    const bool before_edge = least[0] > least[1] + 2 * near;
    if (least[before_edge] == HUGE_VAL) return false;
    double sum = 0, gap = 0, before = 0, beyond = 0;
    Vec<Dim> n;
    for_samples([&](const FaceSample<Dim>& s) {
      if (s.gap <= least[before_edge] + 2 * near) (s.edge == before_edge ? before : beyond) += s.S;
      if (s.edge != before_edge) return;
      const double weight = s.S * std::fmax(1 - (s.gap - least[before_edge]) / near, 0.);
      sum += weight;
      gap += weight * s.gap;
      n += s.n * weight;
    });
    if (!before_edge && beyond > before) return false;
    const Vec<Dim> given = given_normal(part(*begin));
    pair.n = given == Vec<Dim>{} ? n : given;
    for (int k = 0; k < Dim; ++k) {
      if (part(*begin).mirror_axes >> k & 1u && part(*begin).axis != k) pair.n[k] = 0;
    }
    pair.n = normalized(pair.n);
    pair.gap = gap / sum;
    return pair.n != Vec<Dim>{};
  }

  Vec<Dim> given_normal(const FacePart<Dim>& p) const {
    return model_.field_normals[std::size_t{p.field} * model_.fields.size() + model_.rigid_bodies[p.body].field];
  }

  /// Columns that share nodes are solved together: they come to lie beside each other.
  void sort_by_sets() {
    std::vector<std::uint32_t> chain(out_.columns.size());
    std::iota(chain.begin(), chain.end(), 0u);
    const auto root = [&](std::uint32_t c) {
      while (chain[c] != c) c = chain[c] = chain[chain[c]];
      return c;
    };
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> held;  // block, node, column
    for (std::uint32_t c = 0; c < out_.columns.size(); ++c) {
      for (std::uint32_t i = out_.columns[c].first; i < out_.columns[c].end; ++i)
        held.emplace_back(out_.parts[i].block, group(out_.parts[i]).node, c);
    }
    std::sort(held.begin(), held.end());
    for (std::size_t i = 1; i < held.size(); ++i) {
      if (std::get<0>(held[i]) != std::get<0>(held[i - 1]) || std::get<1>(held[i]) != std::get<1>(held[i - 1])) continue;
      const std::uint32_t a = root(std::get<2>(held[i - 1])), b = root(std::get<2>(held[i]));
      chain[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::uint32_t> order(out_.columns.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return root(a) < root(b); });
    std::vector<ContactColumn<Dim>> sorted;
    sorted.reserve(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || root(order[i]) != root(order[i - 1])) out_.first_column.push_back(static_cast<std::uint32_t>(i));
      sorted.push_back(out_.columns[order[i]]);
    }
    out_.columns = std::move(sorted);
    out_.first_column.push_back(static_cast<std::uint32_t>(out_.columns.size()));
  }

  State<Dim>& state_;
  const Model<Dim>& model_;
  FaceContacts<Dim>& out_;
  std::uint8_t face_ = 0;
};

}  // namespace

template <int Dim>
bool is_near_rigid_face(const State<Dim>& state, const Model<Dim>& model, const Vec<Dim>& x, double reach) {
  for (std::size_t r = 0; r < model.rigid_bodies.size(); ++r) {
    const RigidBody<Dim>& body = model.rigid_bodies[r];
    if (body.acts == RigidBody<Dim>::Acts::face && distance_from(body, state.rigid[r].start, x) < reach) return true;
  }
  return false;
}

template <int Dim, class Shape>
void find_face_nodes(State<Dim>& state, const Model<Dim>& model, std::size_t b) {
  state.scratch[b].face_nodes.clear();
  if (!state.nodes.layers[b].near_face || state.nodes.layers[b].shared.empty()) return;
  FaceFinder<Dim, Shape>(state, model, b).run();
}

template <int Dim>
void link_face_columns(State<Dim>& state, const Model<Dim>& model) {
  ColumnLinker<Dim>(state, model).run();
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void find_face_nodes<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM)                                                                        \
  template bool is_near_rigid_face<DIM>(const State<DIM>&, const Model<DIM>&, const Vec<DIM>&, double); \
  template void link_face_columns<DIM>(State<DIM>&, const Model<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
