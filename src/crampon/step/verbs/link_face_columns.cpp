#include "crampon/step/verbs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "crampon/step/rigid_faces.hpp"

namespace crampon {

namespace {

/// Up to this turn of the normal within the longest side of a cell, rad, a face is one all over a column: a radius of four such sides.
constexpr double gentle_turn = 0.25;

/// Where a column acts depends a little on the normal there: in most columns a turn leaves less than a hundredth of the one before, at the ends of a body a
/// tenth.
constexpr int most_turns = 20;

/// Columns from parts that lie beside each other in one list.
template <int Dim>
class ColumnLinker {
 public:
  using PartAt = typename FaceContacts<Dim>::PartAt;

  ColumnLinker(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model)
      : state_(state), work_(work), model_(model), out_(work.face_contacts) {}

  void run() {
    out_.parts.clear();
    out_.columns.clear();
    out_.first_column.clear();
    std::vector<PartAt> all;
    for (std::uint32_t b = 0; b < work_.scratch.size(); ++b) {
      for (std::uint32_t p = 0; p < work_.scratch[b].face_nodes.parts.size(); ++p) all.push_back({b, p});
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
  FacePart<Dim>& part(const PartAt& at) { return work_.scratch[at.block].face_nodes.parts[at.part]; }
  FaceGroup<Dim>& group(const PartAt& at) { return work_.scratch[at.block].face_nodes.groups[part(at).group]; }

  void add_column(const PartAt* begin, const PartAt* end) {
    const FacePart<Dim>& first = part(*begin);
    ContactColumn<Dim> column;
    column.body = first.body;
    column.name = -1 - ((first.column * Dim + first.axis) * 2 + first.up);
    ContactPair<Dim>& pair = column.pair;
    if (!look(begin, end, pair)) return;
    turn_to_column(begin, end, pair);
    column.first = static_cast<std::uint32_t>(out_.parts.size());
    double history = 0, m = 0;
    for (const PartAt* at = begin; at != end; ++at) {
      const FacePart<Dim>& p = part(*at);
      if (p.w == 0) continue;
      column.w += p.w;
      history += p.history;
      m += group(*at).m;
      out_.parts.push_back(*at);
    }
    column.end = static_cast<std::uint32_t>(out_.parts.size());
    if (column.first == column.end) return;
    const std::uint16_t rigid = model_.rigid_bodies[first.body].field;
    pair.law = &model_.contact.law_between(first.field, rigid);
    pair.by_gap = true;
    pair.area = column.w * model_.contact.fields[first.field].thickness;
    if (pair.law->needs_history()) pair.history = history / m;
    pair.name.field_a = first.known_as;
    pair.name.field_b = rigid;
    pair.name.others = first.cracks;
    pair.name.face = face_;
    pair.previous = state_.contacts.find({column.name, pair.name});
    if (state_.clock.step == 0 && pair.law->adheres() && pair.gap <= 0.1 * model_.grid.smallest_cell())
      pair.previous = ContactState::stick;  // glued from the start
    out_.columns.push_back(column);
  }

  /// Normal and gap of a column: those of the particles nearest to the face, the nearer the more. Particles before an edge of the rigid body
  /// tell where none is before a face. False where most lie beyond the end of the face.
  bool look(const PartAt* begin, const PartAt* end, ContactPair<Dim>& pair) {
    const auto for_samples = [&](auto f) {
      for (const PartAt* at = begin; at != end; ++at) {
        const FaceNodes<Dim>& nodes = work_.scratch[at->block].face_nodes;
        const FacePart<Dim>& p = nodes.parts[at->part];
        for (std::uint32_t s = p.first_sample; s < p.end_sample; ++s) f(nodes.samples[s]);
      }
    };
    double least[2] = {HUGE_VAL, HUGE_VAL};  // before faces, before edges
    for_samples([&](const FaceSample<Dim>& s) { least[s.edge] = std::fmin(least[s.edge], s.gap); });
    const double near = 0.25 * model_.grid.smallest_cell();
    before_edge_ = least[0] > least[1] + 2 * near;
    if (least[before_edge_] == HUGE_VAL) return false;
    double sum = 0, gap = 0, before = 0, beyond = 0;
    Vec<Dim> n;
    for_samples([&](const FaceSample<Dim>& s) {
      if (s.gap <= least[before_edge_] + 2 * near) (s.edge == before_edge_ ? before : beyond) += s.S;
      if (s.edge != before_edge_) return;
      const double weight = s.S * std::fmax(1 - (s.gap - least[before_edge_]) / near, 0.);
      sum += weight;
      gap += weight * s.gap;
      n += s.n * weight;
    });
    if (!before_edge_ && beyond > before) return false;
    const Vec<Dim> given = given_normal(part(*begin));
    pair.n = across_mirrors(part(*begin), given == Vec<Dim>{} ? n : given);
    pair.gap = gap / sum;
    return pair.n != Vec<Dim>{};
  }

  /// The nodes' parts of the face along n; those below zero only where they may be.
  void weigh(const PartAt* begin, const PartAt* end, const Vec<Dim>& n, bool signed_parts) {
    for (const PartAt* at = begin; at != end; ++at) {
      FacePart<Dim>& p = part(*at);
      p.w = dot(p.gradient, n);
      if (!signed_parts) p.w = std::fmax(p.w, 0.);
    }
  }

  /// Where volumes of particles differ, a node may have less than nothing of the face; not of a sliver of it.
  bool may_be_signed(const PartAt* begin, const PartAt* end, const Vec<Dim>& n) {
    double sum = 0, size = 0;
    for (const PartAt* at = begin; at != end; ++at) {
      const double w = dot(part(*at).gradient, n);
      sum += w;
      size += std::fabs(w);
    }
    return sum > 0.25 * size;
  }

  /// Finds the parts of a column, and the normal that goes with them: a face that curves gently has the normal that it has where the column acts, at
  /// sum w x/sum w. So pressure has no torque about the centre of a round tool. In a column at an angle to the normal, particles, which stand deeper in the
  /// material, see the face some tenths of a cell to the side. Before other faces what the nearest particles see stands.
  void turn_to_column(const PartAt* begin, const PartAt* end, ContactPair<Dim>& pair) {
    const Vec<Dim> seen = pair.n;
    const bool signed_parts = may_be_signed(begin, end, seen);
    weigh(begin, end, seen, signed_parts);
    if (before_edge_ || given_normal(part(*begin)) != Vec<Dim>{}) return;
    Vec<Dim> n = seen;
    for (int k = 0; k < most_turns; ++k) {
      const auto turned = normal_at_column(begin, end);
      if (!turned || dot(*turned, seen) < of_one_face) break;
      const bool stays = norm(*turned - n) < 1e-12;
      n = *turned;
      weigh(begin, end, n, signed_parts);
      if (!stays) continue;
      pair.n = n;
      return;
    }
    weigh(begin, end, seen, signed_parts);
  }

  /// The normal of a face that curves gently and evenly, at sum w x/sum w.
  std::optional<Vec<Dim>> normal_at_column(const PartAt* begin, const PartAt* end) {
    double sum = 0;
    Vec<Dim> x;
    for (const PartAt* at = begin; at != end; ++at) {
      sum += part(*at).w;
      x += group(*at).x * part(*at).w;
    }
    if (sum <= 0) return std::nullopt;
    x *= 1 / sum;
    const RigidBody<Dim>& body = model_.rigid_bodies[part(*begin).body];
    const RigidPose<Dim>& pose = state_.rigid[part(*begin).body].start;
    const RigidFaceView<Dim> view = see_face(body, pose, x);
    if (!is_surface(body, pose, x, view, model_.grid.smallest_cell())) return std::nullopt;
    double cell = 0;
    for (int k = 0; k < Dim; ++k) cell = std::fmax(cell, model_.grid.cell[k]);
    for (const double side : {cell, -cell}) {
      const double near = turn_along_face(body, pose, x, view, 1e-3 * side) * cell, far = turn_along_face(body, pose, x, view, side) * cell;
      if (far > gentle_turn || std::fabs(far - near) > 0.25 * far + 1e-9) return std::nullopt;
    }
    return across_mirrors(part(*begin), -view.out);
  }

  /// On mirrors the normal lies in them, but for that of a face parallel to one.
  Vec<Dim> across_mirrors(const FacePart<Dim>& p, Vec<Dim> n) const {
    for (int k = 0; k < Dim; ++k) {
      if (p.mirror_axes >> k & 1u && p.axis != k) n[k] = 0;
    }
    return normalized(n);
  }

  Vec<Dim> given_normal(const FacePart<Dim>& p) const { return model_.contact.normal_between(p.field, model_.rigid_bodies[p.body].field); }

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
  StepWork<Dim>& work_;
  const Model<Dim>& model_;
  FaceContacts<Dim>& out_;
  std::uint8_t face_ = 0;     ///< of those of one body along a column
  bool before_edge_ = false;  ///< does the column at hand lie before an edge of the rigid body?
};

}  // namespace

template <int Dim>
void link_face_columns(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  ColumnLinker<Dim>(state, work, model).run();
}

template void link_face_columns<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void link_face_columns<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
