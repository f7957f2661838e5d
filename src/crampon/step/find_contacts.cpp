#include "crampon/step/find_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "crampon/step/contact_cloud.hpp"
#include "crampon/step/contact_groups.hpp"
#include "crampon/step/cracks_between.hpp"
#include "crampon/step/face_to_face.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

namespace {

template <int Dim, class Shape>
class NodeFinder {
 public:
  NodeFinder(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b)
      : state_(state),
        work_(work),
        model_(model),
        b_(b),
        layers_(work.nodes.layers[b]),
        out_(work.scratch[b].contact),
        cloud_(empty_cloud()),
        view_(state, work, model) {}

  void run() {
    for (int node = 0; node < block_nodes<Dim>; ++node) collect_fields(node);
    const auto& c = model_.contact;
    const bool by_regression = c.normal == ContactNormal::logistic_regression || c.normal == ContactNormal::linear_regression;
    const bool among_materials = model_.fields.size() > 1 && (by_regression || model_.outlines_tell(c.material_detection));
    const bool across_cracks = model_.outlines_tell(c.detection) || model_.any_law([](const ContactLaw& law) { return law.has_springs(); });
    if (among_materials || across_cracks) collect_cloud(across_cracks);
    for (ContactNode<Dim>& node : out_.nodes) {
      read_faces(node);
      collect_cracks(node);
      node.first_pair = static_cast<std::uint32_t>(out_.pairs.size());
      pair_materials(node);
      pair_sides(node);
      pair_whole(node);
      node.end_pair = static_cast<std::uint32_t>(out_.pairs.size());
    }
  }

 private:
  /// A thread's own, which keeps its memory from block to block.
  static ContactCloud<Dim>& empty_cloud() {
    static thread_local ContactCloud<Dim> cloud;
    cloud.clear();
    return cloud;
  }
  std::int64_t number_of(int node) const { return model_.grid.node_number(work_.blocks.list[b_].node(node)); }
  Vec<Dim> position_of(int node) const { return model_.grid.node_position(work_.blocks.list[b_].node(node)); }
  const Layer& layer(int l) const { return layers_.node[static_cast<std::size_t>(l)]; }

  /// Fields with mass and the groups that they form.
  void collect_fields(int node) {
    if (layers_.shared[static_cast<std::size_t>(node)] == 0) return;
    std::vector<int>& present = present_;
    present.clear();
    for (std::size_t l = 0; l < layers_.node.size(); ++l) {
      if (work_.nodes.momentum[layers_.slot(l, node)][Dim] > 0 && model_.meets_at_nodes(model_.fields[layers_.node[l].field]))
        present.push_back(static_cast<int>(l));
    }
    if (present.size() < 2) return;
    ContactNode<Dim> contact;
    contact.node = static_cast<std::uint16_t>(node);
    contact.number = number_of(node);
    contact.first_field = static_cast<std::uint32_t>(out_.fields.size());
    contact.first_group = static_cast<std::uint32_t>(out_.groups.size());
    const int groups = find_groups(layers_, model_, present, group_of_);
    for (std::size_t i = 0; i < present.size(); ++i) out_.fields.push_back({present[i], group_of_[i]});
    out_.groups.resize(out_.groups.size() + static_cast<std::size_t>(groups));
    contact.end_field = static_cast<std::uint32_t>(out_.fields.size());
    contact.end_group = static_cast<std::uint32_t>(out_.groups.size());
    if (contact.end_group - contact.first_group > most_groups) {  // more than any node can make sense of: left alone
      out_.fields.resize(contact.first_field);
      out_.groups.resize(contact.first_group);
      ++work_.scratch[b_].ledger.unsolved_nodes;
      return;
    }
    out_.nodes.push_back(contact);
  }

  void collect_cloud(bool everywhere) {
    std::vector<bool> wanted(block_nodes<Dim>, false);
    bool any = false;
    for (const ContactNode<Dim>& node : out_.nodes) {
      for (std::uint32_t f = node.first_field + 1; f < node.end_field; ++f) {
        if (!everywhere && layer(out_.fields[f].layer).field == layer(out_.fields[node.first_field].layer).field) continue;
        wanted[node.node] = any = true;
        break;
      }
    }
    if (any) cloud_.template collect<Shape>(state_, work_, model_, b_, wanted);
  }

  void read_faces(const ContactNode<Dim>& node) {
    faces_.assign(node.end_group - node.first_group, {});
    const Mirrors mirrors = mirrors_at(model_, node.number);
    for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
      const ContactField& field = out_.fields[f];
      const std::size_t i = layers_.slot(field.layer, node.node);
      const ContactSums<Dim>& sums = work_.nodes.contact[i];
      Face<Dim> part;
      part.groups = only(field.group);
      const double m = work_.nodes.momentum[i][Dim];
      part.m = mirrors.images * m;
      part.volume = part.field_volume = mirrors.images * sums.volume();
      part.x = mirrors.together(sums.present());
      part.X = mirrors.together(sums.original());
      part.g = mirrors.together(sums.gradient());
      part.history = mirrors.images * sums.history();
      part.field = part.lowest_field = layer(field.layer).field;
      part.known_as = model_.fields[part.field].bonded_to;
      Face<Dim>& face = faces_[static_cast<std::size_t>(field.group)];
      face.cracks = without_joined(layer(field.layer).cracks, model_);
      face.rigid = model_.is_rigid(part.field);
      face.whole = model_.ignores_cracks(part.field);
      face.add(part);
      ContactGroup<Dim>& group = out_.groups[node.first_group + static_cast<std::uint32_t>(field.group)];
      group.m += m;
      group.rigid = face.rigid;
      group.body = model_.fields[part.field].body;
    }
    for (Face<Dim>& face : faces_) {
      for (const Face<Dim>& other : faces_) {
        face.company |= other.groups;
      }
    }
    tell_apart();
    place_ = {node.number, position_of(node.node), 0, mirrors, &cloud_.at(node.node)};
    for (const Face<Dim>& face : faces_) place_.volume += face.volume;
    for (CloudPoint<Dim>& point : cloud_.at(node.node)) {
      for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
        if (out_.fields[f].layer == point.layer) point.group = only(out_.fields[f].group);
      }
    }
    for (int k = 0; k < Dim; ++k) {
      if (mirrors.axes >> k & 1u) cloud_.add_images(node.node, k);
    }
  }

  /// Contact remembers a face by the lowest field to which bonded laws join it anywhere. Two groups of a node have the same such field when
  /// the fields that join them have no mass at this node. Then each group is remembered by the lowest of its own fields.
  void tell_apart() {
    for (std::size_t g = 1; g < faces_.size(); ++g) {
      for (std::size_t h = 0; h < g; ++h) {
        Face<Dim>&a = faces_[g], &b = faces_[h];
        if (a.known_as == b.known_as && a.cracks == b.cracks) a.known_as = a.lowest_field, b.known_as = b.lowest_field;
      }
    }
  }

  void collect_cracks(const ContactNode<Dim>& node) {
    cracks_.clear();
    for (std::size_t c = 0; c < layers_.node_cracks.size(); ++c) {
      const CrossingSums& sum = work_.nodes.crossing[(layers_.crossing_node_begin + c) * block_nodes<Dim> + node.node];
      if (sum.count<Dim>() == 0) continue;
      CrackAtNode<Dim> crack;
      crack.crack = layers_.node_cracks[c];
      crack.n = normalized(place_.mirrors.mean(sum.normals<Dim>()));
      crack.N = normalized(place_.mirrors.mean(sum.original_normals<Dim>()));
      crack.side = sum.side<Dim>();
      cracks_.push_back(crack);
      out_.sides.push_back({node.number, crack.crack, static_cast<std::int8_t>((crack.side > 0 ? 1 : 0) - (crack.side < 0 ? 1 : 0))});
    }
    if (cracks_.size() > 2) ++work_.scratch[b_].ledger.crowded_nodes;
  }

  // Materials inside a crack field (N13 sec. 2.3).
  void pair_materials(const ContactNode<Dim>& node) {
    const std::size_t begin = out_.pairs.size();
    for (std::size_t a = 0; a < faces_.size(); ++a) {
      if (faces_[a].whole) continue;
      int others = 0;
      for (const Face<Dim>& f : faces_) others += !f.whole && f.cracks == faces_[a].cracks;
      if (others > 2 && model_.contact.several_materials == SeveralMaterials::virtual_material) {
        pair_with_virtual(node, a);
        continue;
      }
      for (std::size_t b = a + 1; b < faces_.size(); ++b) {
        if (!faces_[b].whole && faces_[b].cracks == faces_[a].cracks) pair_faces(node, faces_[a], faces_[b]);
      }
    }
    // N13's virtual materials first, by crack field; solve_contact relies on it.
    std::stable_sort(out_.pairs.begin() + static_cast<std::ptrdiff_t>(begin), out_.pairs.end(),
                     [](const ContactPair<Dim>& a, const ContactPair<Dim>& b) {
                       return std::tuple(!a.is_virtual(), a.name.others) < std::tuple(!b.is_virtual(), b.name.others);
                     });
  }

  /// N13 Eq. 8. The law and the normal are those of the pair with the other material of most volume.
  void pair_with_virtual(const ContactNode<Dim>& node, std::size_t a) {
    Face<Dim> rest;
    rest.cracks = faces_[a].cracks;
    const Face<Dim>* most = nullptr;
    for (std::size_t b = 0; b < faces_.size(); ++b) {
      if (b == a || faces_[b].whole || faces_[b].cracks != rest.cracks) continue;
      rest.add(faces_[b]);
      if (!most || faces_[b].volume > most->volume) most = &faces_[b];
    }
    pair_faces(node, faces_[a], rest, most);
  }

  /// Bodies that no crack parts, with all others whatever cracks part those; rigid ones last (conventions 36).
  void pair_whole(const ContactNode<Dim>& node) {
    for (const bool rigid : {false, true}) {
      for (std::size_t w = 0; w < faces_.size(); ++w) {
        if (!faces_[w].whole || faces_[w].rigid != rigid) continue;
        for (std::size_t f = 0; f < faces_.size(); ++f) {
          const bool met_before = faces_[f].whole && f >= w;
          if (!faces_[f].rigid && (rigid || !met_before)) pair_faces(node, faces_[f], faces_[w]);
        }
      }
    }
  }

  /// a and b as materials; b may be N13's virtual material, of which `facing` is the part that gives law and normal.
  void pair_faces(const ContactNode<Dim>& node, const Face<Dim>& a, const Face<Dim>& b, const Face<Dim>* facing = nullptr) {
    const Face<Dim>& other = facing ? *facing : b;
    ContactPair<Dim> pair;
    pair.law = &model_.law_between(a.field, other.field);
    if (pair.law->ignores()) return;
    const bool bonded = pair.law->joins();
    if (!bonded && !b.rigid && std::fmin(a.m, b.m) < model_.contact.mass_screen * (a.m + b.m)) return;  // conventions 37
    pair.a = a.groups;
    pair.b = b.groups;
    pair.name.field_a = a.known_as;
    pair.name.field_b = facing ? ContactName::all_others : b.known_as;
    pair.name.others = a.cracks;
    if (!view_.see_material(place_, a, b, other, pair)) return;
    const std::size_t first = out_.pairs.size();
    out_.pairs.push_back(pair);
    if (!facing) view_.part_corner(place_, a, b, out_.pairs);
    for (std::size_t q = first; q < out_.pairs.size(); ++q) out_.pairs[q].previous = previous_state(node.number, out_.pairs[q]);
  }

  /// All materials on either side of a crack (N13 sec. 2.3; conventions 34).
  void pair_sides(const ContactNode<Dim>& node) {
    if (cracks_.empty()) return;
    const std::size_t begin = out_.pairs.size();
    sides_.clear();
    for (const Face<Dim>& f : faces_) {
      if (f.whole) continue;
      auto at = std::find_if(sides_.begin(), sides_.end(), [&](const Face<Dim>& s) { return s.cracks == f.cracks; });
      if (at == sides_.end()) {
        sides_.push_back(f);
      } else {
        at->add(f);
      }
    }
    for (std::size_t g = 0; g < sides_.size(); ++g) {
      for (std::size_t h = g + 1; h < sides_.size(); ++h) {
        if (face_each_other(g, h)) pair_across(node, sides_[g], sides_[h]);
      }
    }
    // conventions 13: [0][1], [2][3] of the first crack, then [0][2], [1][3] of the second.
    std::sort(out_.pairs.begin() + static_cast<std::ptrdiff_t>(begin), out_.pairs.end(),
              [](const ContactPair<Dim>& a, const ContactPair<Dim>& b) { return a.name < b.name; });
  }

  /// Sides that differ by one crack do; by several, where no other side of this node lies between them (conventions 50). N13 has pairs of
  /// the first kind only.
  bool face_each_other(std::size_t g, std::size_t h) const {
    const int apart = differences(sides_[g].cracks, sides_[h].cracks);
    if (apart == 1) return true;
    return model_.contact.pairs == ContactPairs::joint && std::none_of(sides_.begin(), sides_.end(), [&](const Face<Dim>& s) {
             return differences(sides_[g].cracks, s.cracks) < apart && differences(s.cracks, sides_[h].cracks) < apart;
           });
  }

  void pair_across(const ContactNode<Dim>& node, const Face<Dim>& g, const Face<Dim>& h) {
    const auto between = cracks_between(g.cracks, h.cracks, cracks_, model_);
    if (!between) return;
    const Face<Dim>&a = between->first_above ? g : h, &b = between->first_above ? h : g;
    ContactPair<Dim> pair;
    pair.law = between->law;
    const double fraction = a.m / (a.m + b.m);
    const bool bonded = pair.law->joins();
    if (!bonded && std::fmin(fraction, 1 - fraction) < model_.contact.mass_screen) return;  // conventions 37
    pair.a = a.groups;
    pair.b = b.groups;
    pair.name = between->name;
    if (!view_.see_across(place_, between->as_one, a, b, pair)) return;
    pair.previous = previous_state(node.number, pair);
    out_.pairs.push_back(pair);
  }

  /// Where the node has changed sides of another crack, the pair was known under the other label.
  ContactState previous_state(std::int64_t number, const ContactPair<Dim>& pair) const {
    if (state_.clock.step == 0 && pair.law->adheres() && pair.gap <= 0.1 * model_.grid.smallest_cell())
      return ContactState::stick;  // glued from the start
    ContactKey key{number, pair.name};
    for (const auto& k : cracks_) {
      if (k.crack == pair.name.crack || pair.name.rest.contains(k.crack) || joins(model_, model_.law_across(k.crack))) continue;
      const double before = state_.contacts.side(number, k.crack);
      if (before * k.side < 0) key.name.others.toggle(k.crack);
    }
    return state_.contacts.find(key);
  }

  State<Dim>& state_;
  StepWork<Dim>& work_;
  const Model<Dim>& model_;
  std::size_t b_;
  const BlockLayers<Dim>& layers_;
  ContactNodes<Dim>& out_;
  std::vector<int> present_, group_of_;
  ContactCloud<Dim>& cloud_;
  FaceToFace<Dim> view_;
  // Of the node at hand.
  std::vector<Face<Dim>> faces_;  ///< by group
  std::vector<Face<Dim>> sides_;  ///< by sides of cracks
  std::vector<CrackAtNode<Dim>> cracks_;
  MeetingPlace<Dim> place_;
};

}  // namespace

template <int Dim, class Shape>
void find_contacts(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  work.scratch[b].contact.clear();
  if (work.nodes.layers[b].shared.empty()) return;
  NodeFinder<Dim, Shape>(state, work, model, b).run();
}

template <int Dim>
void remember_contacts(State<Dim>& state, StepWork<Dim>& work) {
  state.contacts.entries.clear();
  state.contacts.sides.clear();
  for (const auto& scratch : work.scratch) {
    for (const ContactNode<Dim>& node : scratch.contact.nodes) {
      for (std::uint32_t q = node.first_pair; q < node.end_pair; ++q) {
        const ContactPair<Dim>& pair = scratch.contact.pairs[q];
        if (pair.state != ContactState::open) state.contacts.entries.push_back({{node.number, pair.name}, pair.state});
      }
    }
    state.contacts.sides.insert(state.contacts.sides.end(), scratch.contact.sides.begin(), scratch.contact.sides.end());
  }
  for (const ContactColumn<Dim>& column : work.face_contacts.columns) {
    if (column.pair.state != ContactState::open) state.contacts.entries.push_back({{column.name, column.pair.name}, column.pair.state});
  }
  state.contacts.sort();
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void find_contacts<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE
template void remember_contacts<2>(State<2>&, StepWork<2>&);
template void remember_contacts<3>(State<3>&, StepWork<3>&);

}  // namespace crampon
